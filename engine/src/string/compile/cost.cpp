#include "jawari/scene/cost.h"

#include <algorithm>

#include "base/square.h"
#include "jawari/detail/lcp.h"
#include "string/broad_phase/gap_bounds.h"
#include "string/frame/short_frame.h"

namespace jawari {
namespace {

/// A step of free motion: two products and two sums, of which two fuse (mode_run.cpp).
constexpr double step_operations = 3;
/// A frame of free flight: four multiply-adds (flight.cpp).
constexpr double flight_operations = 4;
/// All bounds of one mode (mode_bounds.cpp), the square root as ten.
constexpr double bound_operations = 17;

struct Sizes {
    double modes, contacts, padded_contacts, groups, steps;
    double factored;                               ///< active contacts that solve_lcp() factors, at most
    double pivots, table_pivots, gradient_rounds;  ///< at most
    double room;  ///< active contacts of pivots after projected gradients, or 0
};

Sizes counted_sizes(const StringModel& model) {
    const std::size_t groups =
        model.shape->certificate.group_begin.empty() ? 0 : model.shape->certificate.group_begin.size() - 1;
    const std::size_t factored = std::min(model.shape->contact_count, largest_factor);
    const bool large = model.shape->contact_count > largest_factor;
    return {static_cast<double>(model.shape->stride),
            static_cast<double>(model.shape->contact_count),
            static_cast<double>(model.shape->contact_stride),
            static_cast<double>(groups),
            static_cast<double>(model.shape->steps_per_frame),
            static_cast<double>(factored),
            static_cast<double>(most_pivots(factored)),
            static_cast<double>(most_table_pivots(model.shape->contact_count)),
            static_cast<double>(large ? most_gradient_rounds : 0),
            static_cast<double>(large ? std::min(model.shape->contact_count, model.shape->stride) : 0)};
}

/// Bounds afresh, gaps at both ends of the frame, and the flight between them.
double looking(const Sizes& n) {
    return n.modes * (bound_operations + 3 * n.groups + 2 * n.contacts + flight_operations);
}

/// The forecast: the low modes advanced, and the gaps of all contacts that they predict (forecast.cpp).
double planning(const Sizes& n) {
    const auto frames = static_cast<double>(longest_plan);
    const double low = std::min(n.modes, static_cast<double>(forecast_modes));
    return low * (frames * flight_operations + (frames + 1) * n.contacts);
}

/// Free rates of the contacts near, one row after the other through the steps.
double free_run(const Sizes& n) {
    return n.modes * (2 * n.contacts + n.steps * (step_operations + n.contacts));
}

/// The modes under the frame's impulses.
double impulse_run(const Sizes& n) {
    return n.modes * (n.steps * (step_operations + n.contacts) + 4);
}

/// Impulses of one step applied to the gaps of the frame's later steps, and to those of the step itself.
double spread(const Sizes& n) {
    return n.contacts * n.contacts * (n.steps * (n.steps + 1) / 2 + n.steps);
}

/// A solve whose active set is the last one's: two triangular solves and the residuals.
double steady_solve(const Sizes& n) {
    return n.factored * (n.factored + 1) + square(n.contacts);
}

/// All rounds of projected gradients, and all pivots after them: those exchange rows of a large factor, each
/// in four triangular solves' operations; at most all of them leave it again while it is thinned.
double longest_large_solve(const Sizes& n) {
    if (n.gradient_rounds == 0) return 0;
    const double pivots = 4 * n.room + 16 + 2 * n.room;
    return 2 * (n.gradient_rounds + 2) * square(n.contacts) +
           pivots * (8 * square(n.room) + n.room * n.contacts);
}

/// All pivots that solve_lcp() may take, each with a factor anew in the worst case, and what follows where
/// the factor has no room.
double longest_solve(const Sizes& n) {
    const double factor = n.factored * square(n.factored) / 3;
    return 2 * n.contacts * n.factored + longest_large_solve(n) +
           n.pivots * (2 * factor + 4 * square(n.factored) + n.factored * n.contacts);
}

/// All modes through a short frame, the rates of all contacts at each step, and the response to all impulses
/// (short_frame_modes.cpp).
double short_run(const Sizes& n) {
    const double free = n.modes * n.steps * (step_operations + n.padded_contacts);
    return free + n.modes * (n.steps * (step_operations + n.contacts) + 2);
}

/// Impulses of the steps of a short frame applied to the rates of all later ones, and to the gaps of the step
/// itself once more after a correction (short_frame_contacts.cpp).
double short_spread(const Sizes& n) {
    return n.contacts * n.padded_contacts * (n.steps * (n.steps - 1) / 2 + 2 * n.steps);
}

/// A step of a short frame whose active set is the last one's: the table's product and its correction.
double short_solve(const Sizes& n) {
    return n.padded_contacts * (2 * n.contacts + 1);
}

/// All pivots that a table may take, each with a product, and the general solver where they fail.
double longest_short_solve(const Sizes& n) {
    const double table = n.contacts * n.padded_contacts;
    const double remake = table * n.contacts;
    return remake + n.table_pivots * (table + n.contacts * n.padded_contacts) + longest_solve(n);
}

/// Gaps and rates at the frame's start, where they are not known.
double short_start(const Sizes& n) {
    return 2 * n.modes * n.contacts;
}

/// Without responses every step moves all modes and evaluates all contacts.
double stepped(const Sizes& n) {
    return n.modes * n.steps * (step_operations + 1 + n.contacts + n.contacts);
}

}  // namespace

FrameCost frame_cost(const StringModel& model) JAWARI_REALTIME {
    const Sizes n = counted_sizes(model);
    FrameCost cost;
    cost.flight = flight_operations * n.modes;
    if (model.shape->contact_count == 0) {
        cost.permanent_contact = cost.flight;
        cost.bound = cost.flight + bound_operations * n.modes;
        return cost;
    }
    const double solves = n.steps * steady_solve(n);
    const double longest_solves = n.steps * longest_solve(n);
    if (has_short_frames(model)) {
        cost.permanent_contact = short_run(n) + short_spread(n) + n.steps * short_solve(n);
        cost.bound =
            looking(n) + short_start(n) + short_run(n) + short_spread(n) + n.steps * longest_short_solve(n);
    } else if (model.tuning.response.empty()) {
        cost.permanent_contact = looking(n) + stepped(n) + spread(n) / n.steps + solves;
        cost.bound = looking(n) + planning(n) + stepped(n) + n.contacts * (spread(n) + longest_solves);
    } else {
        cost.permanent_contact = looking(n) + free_run(n) + impulse_run(n) + spread(n) + solves;
        // Where impulses are so many that stepping costs less, the frame begins in contact space and is
        // stepped.
        cost.bound = looking(n) + planning(n) + n.contacts * (free_run(n) + spread(n) + longest_solves) +
                     impulse_run(n) + stepped(n) + longest_solves;
    }
    return cost;
}

double worst_frame_cost(const SceneModel& model) JAWARI_REALTIME {
    double sum = 0;
    for (const StringModel& string : model.strings) sum += frame_cost(string).permanent_contact;
    return sum;
}

}  // namespace jawari
