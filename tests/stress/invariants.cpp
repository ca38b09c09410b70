#include "invariants.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "reach.h"

namespace jawari::stress {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();
/// What a finished solve may leave, as a share of the worst violation (solve_lcp, lcp.cpp): active sets of
/// contacts that nearly coincide are that badly conditioned.
constexpr double largest_relative_residual = 1e-6;

}  // namespace

double operations(const StringModel& model) {
    // Sums over N modes round at most N/2 times in a row (two lanes or more); some twenty operations a mode.
    return 20 + static_cast<double>(model.shape->mode_count) / 2;
}

double step_rounding(const StringModel& model) {
    return eps * operations(model) * rounding_share(model);
}

double sum_rounding(const StringModel& model, double size) {
    return eps * operations(model) * size;
}

double force_rounding(const StringModel& model, double work_J) {
    return sum_rounding(model, work_J);
}

double kick_rounding(const StringModel& model, double kicks, double highest_J) {
    return eps * operations(model) * 2 * kicks * std::sqrt(highest_J);
}

double work_rounding(const StringModel& model, double impulses_Ns, double length_m) {
    return impulses_Ns > 0 ? eps * operations(model) * impulses_Ns * length_m / model.shape->step_s : 0.0;
}

double residual_work(const StringModel& model, double impulses_Ns, double residual_m) {
    return impulses_Ns * residual_m / model.shape->step_s;
}

double gap_rounding_share(const StringModel& model) {
    const double steps = static_cast<double>(model.shape->steps_per_frame);
    return eps * (1024 + static_cast<double>(model.shape->mode_count) + 2 * steps);
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

void check_balance(Judge& judge, const EnergyMeter& meter, double rounding_J, const std::string& where) {
    judge.at_most(Invariant::EnergyBalance, meter.worst_imbalance, rounding_J, where);
    judge.at_most(Invariant::EnergyBalance, -meter.dissipated, 0, where + " losses");
}

void check_rise_of_step(Judge& judge, const EnergyMeter& meter, double rounding_J, const std::string& where) {
    judge.at_most(Invariant::EnergyRise, meter.worst_rise, rounding_J, where);
}

void check_rise_of_block(Judge& judge, double rise_J, double rounding_J, const std::string& where) {
    judge.at_most(Invariant::EnergyRise, rise_J, rounding_J, where);
}

void check_depth(Judge& judge, double depth, double allowed, const std::string& where) {
    judge.at_most(Invariant::Penetration, depth, allowed, where);
}

void check_residual(Judge& judge, double residual, double travel, double rounding, const std::string& where) {
    judge.at_most(Invariant::Residual, residual, largest_relative_residual * travel + rounding, where);
}

void check_truncation(Judge& judge, const Counters& counters, bool independent, const std::string& where) {
    const double allowed = independent ? 0.0 : 1 + 0.01 * static_cast<double>(counters.solves);
    judge.at_most(Invariant::Truncation, static_cast<double>(counters.truncated_solves), allowed, where);
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
