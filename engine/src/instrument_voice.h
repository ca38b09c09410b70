// One voice: a pluck, its decay under the string's own losses or the damping hand's, and its end.
#pragma once

#include "jawari/instrument_model.h"
#include "jawari/instrument_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// From rest: the finger begins to lift the string at `fret`. velocity: above 0, to 1.
void start_voice(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                 std::size_t fret, double velocity) JAWARI_REALTIME;

/// Puts the damping hand on a sounding voice: position and true velocity stay as they are.
void damp_voice(const InstrumentStringModel& string, Voice& voice) JAWARI_REALTIME;

/// Takes a voice away within the model's fade.
void fade_voice(Voice& voice) JAWARI_REALTIME;

/// Advances a voice that is not idle by one output frame and returns its output at the frame's end. May leave
/// it idle.
double advance_voice(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                     Counters& finished) JAWARI_REALTIME;

/// The voice's energy [J].
double voice_energy(const InstrumentStringModel& string, const Voice& voice) JAWARI_REALTIME;

}  // namespace jawari
