#include "player/governor.h"

#include <algorithm>

namespace jawari::host {

namespace {

OverloadLevel shifted(OverloadLevel level, int by) {
    return static_cast<OverloadLevel>(static_cast<int>(level) + by);
}

/// `levels` are given up. If that was just after one had come back, the next return takes longer.
void step_down(Governor& governor, int levels) {
    const OverloadSettings& settings = governor.settings;
    const bool relapsed = governor.came_back && governor.settled_s < settings.return_s;
    if (relapsed) {
        governor.return_s = std::min(2 * governor.return_s, settings.longest_return_s);
    } else if (governor.level == OverloadLevel::Full) {
        governor.return_s = settings.return_s;
    }
    governor.came_back = false;
    governor.level = shifted(governor.level, levels);
    governor.settled_s = 0;
}

void step_up(Governor& governor) {
    governor.came_back = true;
    governor.level = shifted(governor.level, -1);
    governor.settled_s = 0;
    governor.calm_s = 0;
}

// The cost of a note follows what is measured: fast upward, because the next block must not be late; slowly
// downward, because notes differ. A block that the scheduler held up counts as one of most_growth times the
// cost known.
constexpr double rise_share = 0.5;
constexpr double fall_share = 0.1;
constexpr double most_growth = 4;
/// In each block with notes, the largest work that is remembered becomes that of lesser ones by this factor.
constexpr double work_memory = 0.99;

std::size_t index_of(OverloadLevel level) {
    return static_cast<std::size_t>(level);
}

}  // namespace

bool foresee(Governor& governor, const NoteWork& work, double duration_s) JAWARI_REALTIME {
    const OverloadSettings& settings = governor.settings;
    if (!settings.enabled) return false;
    const auto load_at = [&](std::size_t level) {
        return governor.load + governor.note_s * work[level] / duration_s;
    };
    const std::size_t now = index_of(governor.level);
    std::size_t chosen = now;
    for (std::size_t level = now;
         load_at(chosen) > settings.foreseen && level < index_of(OverloadLevel::Fading); ++level) {
        if (work[level] < work[chosen]) chosen = level;
    }
    if (chosen == now) return false;
    step_down(governor, static_cast<int>(chosen - now));
    return true;
}

void learn_note_cost(Governor& governor, double work, double load, double duration_s) JAWARI_REALTIME {
    // Before the first block there is no load to compare with.
    if (!(work > 0) || governor.load == 0) return;
    governor.most_work = std::max(work, work_memory * governor.most_work);
    const double measured_s = std::max(0.0, load - governor.load) * duration_s / work;
    if (governor.note_s == 0) {
        governor.note_s = measured_s;
        return;
    }
    const double counted_s = std::min(measured_s, most_growth * governor.note_s);
    // Least squares: what else has changed in the block weighs the less, the more its notes cost.
    const double weight = work / governor.most_work;
    const double share = weight * weight * (counted_s > governor.note_s ? rise_share : fall_share);
    governor.note_s += share * (counted_s - governor.note_s);
}

bool govern(Governor& governor, double load, double duration_s) JAWARI_REALTIME {
    const OverloadSettings& settings = governor.settings;
    if (!settings.enabled) return false;
    // A single block that the scheduler held up must not look like an overload.
    const double share = std::min(0.5, duration_s / settings.follow_s);
    governor.load += share * (std::min(load, 1.0) - governor.load);
    governor.settled_s += duration_s;
    governor.calm_s = governor.load < settings.low ? governor.calm_s + duration_s : 0;
    if (governor.load > settings.high && governor.level < OverloadLevel::Fading &&
        (governor.level == OverloadLevel::Full || governor.settled_s > settings.settle_s)) {
        step_down(governor, 1);
        return true;
    }
    if (governor.level > OverloadLevel::Full && governor.calm_s > governor.return_s) {
        step_up(governor);
        return true;
    }
    return false;
}

}  // namespace jawari::host
