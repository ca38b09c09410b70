// A voice on a bridge that moves, frame by frame (docs/engine/model.md, "The moving bridge").
#pragma once

#include <cstddef>

#include "instrument/voice/voice.h"
#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Begins a frame: sets what the voice answers to the bridge. Its weight follows fades and tension; what that
/// changes of the coupling is metered.
void begin_coupled_frame(const InstrumentModel& model, InstrumentState& state,
                         VoiceOnBridge& on_bridge) JAWARI_REALTIME;

/// Whether the voice goes on in a run in which only its motion changes: its weight and what it answers stay;
/// sets both then.
bool goes_on_steadily(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                      VoiceOnBridge& on_bridge) JAWARI_REALTIME;

/// Crosses the frame at VoiceOnBridge::zeta_m; sets left_N and adds what the voice gives to the outputs but
/// for the body.
void end_coupled_frame(const InstrumentModel& model, InstrumentState& state, VoiceOnBridge& on_bridge,
                       double smoothing, VoiceSignals& sum) JAWARI_REALTIME;

/// After the body has moved: what the coupling of a voice that has ended held is metered.
void leave_bridge(const InstrumentModel& model, InstrumentState& state,
                  const VoiceOnBridge& on_bridge) JAWARI_REALTIME;

/// Energy of the coupling of all voices as they are [J].
double coupling_energy(const InstrumentModel& model, const InstrumentState& state) JAWARI_REALTIME;

}  // namespace jawari
