#include "fma_peak.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fma_peak.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace jawari::benchmarks::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

std::size_t multiply_adds(std::size_t rounds, double& sink) {
    constexpr std::size_t chains = 10;  // more than latency times throughput of any core so far
    const hn::ScalableTag<double> d;
    hn::Vec<decltype(d)> sum[chains];
    for (std::size_t i = 0; i < chains; ++i) sum[i] = hn::Set(d, static_cast<double>(i));
    const auto factor = hn::Set(d, 0.999999);
    const auto term = hn::Set(d, 1e-6);
    for (std::size_t n = 0; n < rounds; ++n) {
        for (std::size_t i = 0; i < chains; ++i) sum[i] = hn::MulAdd(sum[i], factor, term);
    }
    auto total = hn::Zero(d);
    for (std::size_t i = 0; i < chains; ++i) total = hn::Add(total, sum[i]);
    sink = hn::GetLane(hn::SumOfLanes(d, total));
    return rounds * chains * hn::Lanes(d);
}

}  // namespace jawari::benchmarks::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::benchmarks {

HWY_EXPORT(multiply_adds);

std::size_t multiply_adds(std::size_t rounds, double& sink) {
    return HWY_DYNAMIC_DISPATCH(multiply_adds)(rounds, sink);
}

}  // namespace jawari::benchmarks
#endif
