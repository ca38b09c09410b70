// One voice, a motion of a string: how it starts, is excited, damped, carried over and ends.
#pragma once

#include <span>

#include "instrument/model/played_string.h"
#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// An idle voice with room for every stop and quality level up to the sizes.
Voice make_voice(const StringSizes& sizes);

/// The voice is idle and has done nothing.
void reset_voice(Voice& voice) JAWARI_REALTIME;

/// At rest at `fret`, everything beneath lowered by `action_m`; sounding, without force.
void start_voice(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                 std::size_t fret, int channel, double action_m) JAWARI_REALTIME;

/// Excites a voice. position_factor: of the distance from the bridge.
void strike_voice(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                  const Stroke& stroke, double position_factor) JAWARI_REALTIME;

/// Takes a voice away within the model's fade, in which it flies freely unless obstacles hold it.
void fade_voice(Voice& voice) JAWARI_REALTIME;

/// What one voice adds to a frame.
struct VoiceSignals {
    double pickups = 0;  ///< with level, before left and right
    double left = 0, right = 0;
    double bridge_N = 0;  ///< force that drives the body, with level
};

/// Advances the voice by as many output frames as there are `sums`, at most longest_voice_run, or until it
/// has ended; adds what it gives at the end of each of them. `smoothing`: share of the way to their targets
/// that gains go in a frame. The numbers do not depend on how frames are divided into runs.
void advance_voice(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                   double smoothing, InstrumentState& state, std::span<VoiceSignals> sums) JAWARI_REALTIME;

/// The voice's energy beyond that of its rest [J].
double voice_energy(const InstrumentStringModel& string, Voice& voice) JAWARI_REALTIME;

}  // namespace jawari
