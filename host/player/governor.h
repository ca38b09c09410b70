// When to lower the quality of live playing, and when to raise it again: a function of how long blocks took.
#pragma once

#include "jawari/realtime.h"

namespace jawari::host {

/// What is given up, in this order; every level includes those before it.
enum class OverloadLevel : int {
    Full = 0,  ///< nothing: the instrument as its preset says
    ReleasedLower =
        1,  ///< strings that nobody holds lose their high modes and half their contact rate or more
    ReleasedLowest = 2,  ///< these strings at the lowest quality level
    AllLower = 3,        ///< held strings too, one level down
    AllLowest = 4,       ///< all strings at the lowest quality level
    Fading = 5           ///< instruments that ring out fade, and released motions, the oldest first
};

struct OverloadSettings {
    bool enabled = true;
    double high = 0.7;             ///< load, smoothed, above which a level is given up
    double low = 0.35;             ///< load below which one may come back
    double follow_s = 0.004;       ///< smoothing: a block that the scheduler held up is not an overload
    double settle_s = 0.006;       ///< least time between two levels given up
    double return_s = 2;           ///< of low load before a level comes back
    double longest_return_s = 30;  ///< doubled up to this each time a level had to be given up again at once
};

struct Governor {
    OverloadSettings settings;
    OverloadLevel level = OverloadLevel::Full;
    double load = 0;         ///< smoothed
    double settled_s = 0;    ///< since the last change
    double calm_s = 0;       ///< for which the load has been low
    double return_s = 0;     ///< in force, once a level was given up
    bool came_back = false;  ///< the last change was for the better
};

/// After a block that took `load` of its duration. True if the level has changed.
bool govern(Governor& governor, double load, double duration_s) JAWARI_REALTIME;

}  // namespace jawari::host
