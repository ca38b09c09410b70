#include "string/kernels/response_sums.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "string/kernels/response_sums.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;
using Sources = std::span<const std::uint32_t>;

/// Vectors of targets that stay in registers while all sources are added to them.
constexpr std::size_t chunk_vectors = 4;

/// Responses of neighbouring targets to one source, from a matrix.
struct DenseResponses {
    const ContactOperator& A;
    std::size_t first;  ///< target

    HWY_INLINE Vec at(std::size_t source, std::size_t offset) const {
        return hn::LoadU(Lanes(), A.values + source * A.stride + first + offset);
    }
};

/// The same from a table by distance. Left of the source the table is read from its end, which it repeats
/// from its start on: values[|d|] = values[period - |d|].
struct GridResponses {
    const ContactOperator& A;
    std::size_t first;  ///< node of the first target

    HWY_INLINE Vec at(std::size_t source, std::size_t offset) const {
        const Lanes d;
        const std::size_t node = A.node[source];
        const std::size_t apart = first < node ? A.period + first - node : first - node;
        return hn::Sub(hn::LoadU(d, A.values + apart + offset),
                       hn::LoadU(d, A.values + first + node + offset));
    }
};

/// out[i] += sum of responses x for i < vectors x lanes.
template <std::size_t vectors, class Responses>
HWY_INLINE void add_chunk(const Responses& responses, const Sources& sources, const double* x, double* out) {
    const Lanes d;
    Vec sum[vectors];
    for (std::size_t i = 0; i < vectors; ++i) sum[i] = hn::LoadU(d, out + i * hn::Lanes(d));
    for (const auto source : sources) {
        const Vec scale = hn::Set(d, x[source]);
        for (std::size_t i = 0; i < vectors; ++i)
            sum[i] = hn::MulAdd(responses.at(source, i * hn::Lanes(d)), scale, sum[i]);
    }
    for (std::size_t i = 0; i < vectors; ++i) hn::StoreU(sum[i], d, out + i * hn::Lanes(d));
}

template <std::size_t vectors>
HWY_INLINE void add_to_neighbours(const ContactOperator& A, const Sources& sources, const double* x,
                                  std::size_t target, double* out) {
    if (A.node == nullptr) {
        add_chunk<vectors>(DenseResponses{A, target}, sources, x, out + target);
    } else {
        add_chunk<vectors>(GridResponses{A, A.node[target]}, sources, x, out + target);
    }
}

/// `count` targets from `target` on, at neighbouring nodes.
void add_run(const ContactOperator& A, const Sources& sources, const double* x, std::size_t target,
             std::size_t count, double* out) {
    const std::size_t lanes = hn::Lanes(Lanes());
    std::size_t done = 0;
    for (; done + chunk_vectors * lanes <= count; done += chunk_vectors * lanes)
        add_to_neighbours<chunk_vectors>(A, sources, x, target + done, out);
    for (; done + lanes <= count; done += lanes) add_to_neighbours<1>(A, sources, x, target + done, out);
    for (; done < count; ++done) {
        double sum = 0;
        for (const auto source : sources) sum += A(source, target + done) * x[source];
        out[target + done] += sum;
    }
}

bool are_neighbours(const ContactOperator& A, std::uint32_t left, std::uint32_t right) {
    return right == left + 1 && (A.node == nullptr || A.node[right] == A.node[left] + 1);
}

void add_responses(const ContactOperator& A, const Sources& sources, const double* x, const Sources& targets,
                   double* out) {
    for (std::size_t begin = 0; begin < targets.size();) {
        std::size_t end = begin + 1;
        while (end < targets.size() && are_neighbours(A, targets[end - 1], targets[end])) ++end;
        add_run(A, sources, x, targets[begin], end - begin, out);
        begin = end;
    }
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(add_responses);

void add_responses(const ContactOperator& A, std::span<const std::uint32_t> sources, const double* x,
                   std::span<const std::uint32_t> targets, double* out) noexcept {
    HWY_DYNAMIC_DISPATCH(add_responses)(A, sources, x, targets, out);
}

}  // namespace jawari::kernels
#endif
