// Slow controls: bends, vibrato, slides, palm and gains, looked at every control_frames frames.
#pragma once

#include <cstdint>

#include "jawari/instrument_model.h"
#include "jawari/instrument_state.h"
#include "jawari/realtime.h"

namespace jawari {

inline constexpr std::uint64_t control_frames = 32;
/// Gains and bends follow their controls with this time constant [s].
inline constexpr double gain_follow_s = 0.003;
inline constexpr double bend_follow_s = 0.004;

inline double parameter_of(const ChannelState& channel, ParameterId id) {
    return channel.parameters[static_cast<std::size_t>(id)];
}

/// Share of the way to a target that a value goes in `frames`.
double follow_share(const InstrumentModel& model, double frames, double time_s) JAWARI_REALTIME;

/// Bend that the string's sounding note should have now, without slides [semitones].
double bend_target(const InstrumentModel& model, const InstrumentState& state, std::size_t s) JAWARI_REALTIME;

/// Gains that a motion of string s should have.
VoiceGains gain_targets(const InstrumentModel& model, const InstrumentState& state, std::size_t s,
                        int channel) JAWARI_REALTIME;

/// Once every control_frames frames.
void follow_controls(const InstrumentModel& model, InstrumentState& state) JAWARI_REALTIME;

}  // namespace jawari
