#include "player/governor.h"

#include <algorithm>

namespace jawari::host {

namespace {

OverloadLevel shifted(OverloadLevel level, int by) {
    return static_cast<OverloadLevel>(static_cast<int>(level) + by);
}

/// A level is given up. If that was just after one had come back, the next return takes longer.
void step_down(Governor& governor) {
    const OverloadSettings& settings = governor.settings;
    const bool relapsed = governor.came_back && governor.settled_s < settings.return_s;
    if (relapsed) {
        governor.return_s = std::min(2 * governor.return_s, settings.longest_return_s);
    } else if (governor.level == OverloadLevel::Full) {
        governor.return_s = settings.return_s;
    }
    governor.came_back = false;
    governor.level = shifted(governor.level, 1);
    governor.settled_s = 0;
}

void step_up(Governor& governor) {
    governor.came_back = true;
    governor.level = shifted(governor.level, -1);
    governor.settled_s = 0;
    governor.calm_s = 0;
}

}  // namespace

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
        step_down(governor);
        return true;
    }
    if (governor.level > OverloadLevel::Full && governor.calm_s > governor.return_s) {
        step_up(governor);
        return true;
    }
    return false;
}

}  // namespace jawari::host
