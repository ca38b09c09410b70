// Frames that a string flies together while a force acts on it whose size becomes known only as the frames
// pass. Who lets it act keeps the motion; here is what the string must know of it.
#pragma once

#include <cstddef>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"
#include "string/broad_phase/gap_bounds.h"

namespace jawari {

/// A force on one row, held over each frame (docs/engine/certificate.md, section 7).
struct ForceShape {
    std::size_t modes = 0;          ///< that it reaches (padded)
    const double* still = nullptr;  ///< displacement of each mode at rest under a unit of it
    double bend_m = 0;              ///< at no contact is the string then bent by more than this [m]
    double sway_m = 0;              ///< nor by more than this at any time after it is let go from there [m]
};

/// What a flight may do.
struct ForcedFlight {
    std::size_t frames = 0;  ///< that pass at most; 0: there is no flight
    /// By how much the force's size may change altogether, from the one it had before. The next frame must
    /// not pass if it would be more.
    double travel = 0;
};

/// Begins a flight of at most `frames` frames, unless the string may be struck however little the force
/// changes. `now`: its size in the frame before, or any other. `expected`: travel that is reckoned with.
ForcedFlight begin_forced_flight(const StringModel& model, StringState& state, const ForceShape& shape,
                                 double now, std::size_t frames, double expected) JAWARI_REALTIME;

/// Whether a flight with this many frames to come goes on; notice_change() and all that forgets bounds end
/// it.
inline bool goes_on_in_flight(const StringState& state, std::size_t frames_left) {
    return frames_left > 0 && planned_frames(state) == frames_left;
}

/// The next frame of the flight passes.
inline void pass_in_flight(const StringModel& model, StringState& state) JAWARI_REALTIME {
    state.counters.steps += model.shape->steps_per_frame;
    state.counters.flown_frames += 1;
    state.frame += 1;
}

/// The flight ends, and displacement and velocity are those of now. `finite`: they are; else the string
/// starts again at rest.
void end_forced_flight(const StringModel& model, StringState& state, bool finite) JAWARI_REALTIME;

}  // namespace jawari
