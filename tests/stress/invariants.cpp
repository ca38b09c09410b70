#include "invariants.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "reach.h"
#include "string_watch.h"

namespace jawari::stress {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();
/// What a finished solve may leave, as a share of the worst violation (solve_lcp, lcp.cpp): active sets of
/// contacts that nearly coincide are that badly conditioned.
constexpr double largest_relative_residual = 1e-6;

}  // namespace

RoundingBounds rounding_bounds(const StringModel& model, double impulse) {
    // Sums over N modes round at most N/2 times in a row (two lanes or more); some twenty operations a mode.
    const double operations = 20 + static_cast<double>(model.mode_count) / 2;
    return {eps * operations * rounding_share(model), eps * operations * impulse};
}

double gap_rounding_share(const StringModel& model) {
    const double steps = static_cast<double>(model.steps_per_frame);
    return eps * (1024 + static_cast<double>(model.mode_count) + 2 * steps);
}

double depth_of_law(ImpactLaw law, double restitution, double travel) {
    switch (law) {
        case ImpactLaw::Signorini:
            return 0;
        case ImpactLaw::PaoliSchatzman:
            return 2 * restitution / (1 + restitution) * travel;
        case ImpactLaw::Newton:
        case ImpactLaw::Passive:
            return 1.5 * travel;
    }
    return infinity;
}

void check_finite(Judge& judge, std::span<const double> values, const std::string& where) {
    const auto lost =
        std::count_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
    judge.at_most(Invariant::Finite, static_cast<double>(lost), 0, where);
}

void check_resets(Judge& judge, std::uint64_t resets, const std::string& where) {
    judge.at_most(Invariant::Finite, static_cast<double>(resets), 0, where + " resets");
}

void check_balance(Judge& judge, const EnergyMeter& meter, double highest, const RoundingBounds& rounding,
                   const std::string& where) {
    judge.at_most(Invariant::EnergyBalance, meter.worst_imbalance, rounding.step * highest, where);
    judge.at_most(Invariant::EnergyBalance, -meter.dissipated, 0, where + " losses");
}

void check_rise_of_step(Judge& judge, const EnergyMeter& meter, double highest,
                        const RoundingBounds& rounding, const std::string& where) {
    judge.at_most(Invariant::EnergyRise, meter.worst_rise, (rounding.step + rounding.impulse) * highest,
                  where);
}

void check_rise_of_block(Judge& judge, double rise, double highest, const RoundingBounds& rounding,
                         double frames, double impulses, const std::string& where) {
    const double share = (frames + 1) * rounding.step + impulses * (rounding.step + rounding.impulse);
    judge.at_most(Invariant::EnergyRise, rise, share * highest, where);
}

void check_depth(Judge& judge, double depth, double allowed, const std::string& where) {
    judge.at_most(Invariant::Penetration, depth, allowed, where);
}

void check_residual(Judge& judge, double residual, double travel, double rounding, const std::string& where) {
    judge.at_most(Invariant::Residual, residual, largest_relative_residual * travel + rounding, where);
}

void check_truncation(Judge& judge, std::uint64_t truncated, const std::string& where) {
    judge.at_most(Invariant::Truncation, static_cast<double>(truncated), 0, where);
}

void check_output(Judge& judge, std::span<const double> values, double allowed, const std::string& where) {
    double largest = 0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    judge.at_most(Invariant::Output, largest, (1 + 1e-9) * allowed, where);
}

void check_not_negative(Judge& judge, std::span<const double> values, const std::string& where) {
    double lowest = 0;
    for (const double value : values) lowest = std::min(lowest, value);
    judge.at_most(Invariant::Output, -lowest, 0, where);
}

void check_same(Judge& judge, std::span<const double> first, std::span<const double> second,
                const std::string& where) {
    double differing = first.size() == second.size() ? 0.0 : infinity;
    for (std::size_t n = 0; n < std::min(first.size(), second.size()); ++n)
        differing += std::memcmp(&first[n], &second[n], sizeof(double)) == 0 ? 0 : 1;
    judge.at_most(Invariant::Determinism, differing, 0, where);
}

}  // namespace jawari::stress
