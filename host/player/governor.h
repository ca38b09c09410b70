// When to lower the quality of live playing, and when to raise it again: a function of how long blocks took,
// and of what the notes of the coming block cost.
#pragma once

#include <array>
#include <cstddef>

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

inline constexpr std::size_t overload_level_count = 6;

struct OverloadSettings {
    bool enabled = true;
    double high = 0.7;             ///< load, smoothed, above which a level is given up
    double foreseen = 0.8;         ///< load of the coming block above which its notes begin lower
    double low = 0.35;             ///< load below which one may come back
    double follow_s = 0.004;       ///< smoothing: a block that the scheduler held up is not an overload
    double settle_s = 0.006;       ///< least time between two levels given up
    double return_s = 2;           ///< of low load before a level comes back
    double longest_return_s = 30;  ///< doubled up to this each time a level had to be given up again at once
};

/// What the notes that begin in a block cost in it, at each OverloadLevel [multiply-adds of FrameCost].
using NoteWork = std::array<double, overload_level_count>;

struct Governor {
    OverloadSettings settings;
    OverloadLevel level = OverloadLevel::Full;
    double load = 0;         ///< smoothed
    double settled_s = 0;    ///< since the last change
    double calm_s = 0;       ///< for which the load has been low
    double return_s = 0;     ///< in force, once a level was given up
    bool came_back = false;  ///< the last change was for the better
    double note_s = 0;  ///< what a multiply-add of a new note takes, by the blocks so far [s]; 0: not known
    double most_work = 0;  ///< of the new notes of a block, lately [multiply-adds]
};

/// Before a block: takes the first level at which the load so far and the block's new notes fit, or the one
/// at which they cost least. True if the level has changed.
bool foresee(Governor& governor, const NoteWork& work, double duration_s) JAWARI_REALTIME;

/// After a block that took `load` of its duration, before govern(): what its new notes, of `work`
/// multiply-adds, have added to the load before.
void learn_note_cost(Governor& governor, double work, double load, double duration_s) JAWARI_REALTIME;

/// After a block that took `load` of its duration. True if the level has changed.
bool govern(Governor& governor, double load, double duration_s) JAWARI_REALTIME;

}  // namespace jawari::host
