// A voice's end on a moving bridge, over one output frame. The bridge acts on the string as a force held on
// the row b (StoppedStringModel::end_row): b_k zeta on mode k, zeta the bridge's mean displacement in the
// frame. It is solved together with touches and exciter (docs/engine/model.md, "The moving bridge").
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/detail/touches.h"
#include "jawari/realtime.h"

namespace jawari {

/// What a string's end is made of at one stop and tension.
struct BridgeEndModel {
    const double* row = nullptr;   ///< b, StringShape::stride long [N m^(-3/2)]
    double rest_N = 0;             ///< b . q at rest [N]
    double stiffness_N_per_m = 0;  ///< kappa: what the end resists if the modes stand still [N/m]
    double root = 0;               ///< StoppedStringModel::end_root, with the growth of a bend [J^(1/2)/m]
    double strength = 0;           ///< StoppedStringModel::end_strength, with the growth of a bend [N/m]
};

/// Begins a frame: moves the touches on, and finds what the voice answers to the bridge.
void begin_end_frame(const StringModel& model, const StringState& string, TouchState& touches,
                     const BridgeEndModel& end, BridgeEndFrame& frame) JAWARI_REALTIME;

/// The exciter's force where the bridge's displacement is zeta_m + zeta_per_N F_exciter; moves the exciter
/// on.
double strike_on_bridge(const StringModel& model, TouchState& touches, const BridgeEndFrame& frame,
                        double zeta_m, double zeta_per_N) JAWARI_REALTIME;

/// Force on the bridge at a frame's end.
struct EndForce {
    double expected_N = 0;  ///< as the answer has it [N]
    double force_N = 0;     ///< as it is: the same unless a contact acted [N]
};

/// Crosses the frame with the bridge at zeta_m in its mean.
EndForce end_end_frame(const StringModel& model, StringState& string, TouchState& touches,
                       const BridgeEndModel& end, const BridgeEndFrame& frame, double zeta_m,
                       PlayerWork& work) JAWARI_REALTIME;

/// Force on the bridge as the string now is, beyond the one at rest: b . (q - h v/2) [N].
double end_force(const StringModel& model, const StringState& string,
                 const BridgeEndModel& end) JAWARI_REALTIME;

}  // namespace jawari
