// Touches: dashpots and springs at places of a string, as forces held over a frame. With w = phi . (q - h
// v/2) the work of a held force F is exactly F (w_end - w_start) (docs/engine/model.md, "Energy"), so that F
// = -c (w_end - w_start)/T dissipates for every c >= 0 and F = -k (w_end + w_start)/2 conserves k w^2/2. Both
// are solved together with each other and with the exciter, implicitly, from the free flight of the frame.
// Contacts that act within the frame change the path, not the force: PlayerWork tells by how much.
#pragma once

#include <algorithm>

#include "instrument/touch/touch_kernels.h"
#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/detail/touches.h"
#include "jawari/realtime.h"

namespace jawari {

/// Allocates for strings of up to `stride` modes.
TouchState make_touch_state(std::size_t stride);

/// Nothing touches the string any more.
void lift_all_touches(TouchState& touches) JAWARI_REALTIME;

/// Whether neither hands nor an exciter act on the string.
inline bool is_untouched(const TouchState& touches) {
    if (touches.exciter.phase != ExciterPhase::None) return false;
    return std::none_of(touches.touches.begin(), touches.touches.end(),
                        [](const Touch& touch) { return touch.active; });
}

/// How a touch is to lie on the string.
struct TouchPlan {
    double x_m = 0;      ///< from the start of the speaking length
    double width_m = 0;  ///< over which it is spread
    double sweep_m = 0;  ///< how far it sweeps to either side; without a spring
    double damping_kg_per_s = 0;
    double stiffness_N_per_m = 0;    ///< relaxed where the string now is
    std::uint64_t frames = 0;        ///< 0: it stays
    double ease_frames = 0;          ///< in which it comes, and leaves: a sudden force would click
    double noise_N = 0;              ///< rms of the noise of its coming
    std::uint64_t noise_frames = 0;  ///< that the noise lasts
};

void lay_touch(const StringModel& model, const StringState& string, TouchState& touches, TouchSlot slot,
               const TouchPlan& plan) JAWARI_REALTIME;
/// Changes how hard a touch is that lies already.
void press_touch(TouchState& touches, TouchSlot slot, double damping_kg_per_s) JAWARI_REALTIME;
/// It begins to leave.
void lift_touch(TouchState& touches, TouchSlot slot) JAWARI_REALTIME;

inline Touch& touch_at(TouchState& touches, TouchSlot slot) {
    return touches.touches[static_cast<std::size_t>(slot)];
}

/// Sets the string's excitation for the coming frame.
void apply_touches(const StringModel& model, StringState& string, TouchState& touches) JAWARI_REALTIME;

/// A run of frames of a string that nothing can strike, under its touches.
struct TouchedRun {  // NOLINT(cppcoreguidelines-pro-type-member-init): the first `count` paths are set
    const double* read_row = nullptr;  ///< over the displacements, StringShape::stride long
    bool goes_on = false;              ///< another frame of the run follows
    kernels::TouchedRows known;        ///< of the coming frame, unless `count` is 0
};

/// apply_touches(), a frame of a string for which flies_always() holds, and meter_touches(), in fewer sweeps.
/// Returns what `read_row` reads at the frame's end.
double fly_touched(const StringModel& model, StringState& string, TouchState& touches, TouchedRun& run,
                   PlayerWork& work) JAWARI_REALTIME;

/// The string has another number of modes from now on, `kept` of which are those it had.
void rewrite_touches(const StringModel& model, TouchState& touches, std::size_t kept) JAWARI_REALTIME;

/// After the frame: what the forces have done. `struck`: contacts acted in the frame.
void meter_touches(const StringModel& model, const StringState& string, TouchState& touches, bool struck,
                   PlayerWork& work) JAWARI_REALTIME;

/// row_k <- phi_k averaged over width_m around x, for the first `modes` (padded); 0 in the padding.
void write_point_row(const StringModel& model, std::size_t modes, double x, double width_m,
                     double* row) JAWARI_REALTIME;

}  // namespace jawari
