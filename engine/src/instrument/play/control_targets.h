// What a string's bend and gains should be now, given its channel's controls. Pure functions.
#pragma once

#include <cstddef>

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

inline ChannelState& channel_of(InstrumentState& state, int channel) {
    return state.channels[static_cast<std::size_t>(channel)];
}
inline const ChannelState& channel_of(const InstrumentState& state, int channel) {
    return state.channels[static_cast<std::size_t>(channel)];
}

inline double parameter_of(const ChannelState& channel, ParameterId id) {
    return channel.parameters[static_cast<std::size_t>(id)];
}
inline double parameter_of(const InstrumentState& state, int channel, ParameterId id) {
    return parameter_of(channel_of(state, channel), id);
}

/// Share of the distance to its target that a value with time constant `time_s` goes in `frames`.
double follow_share(const InstrumentModel& model, double frames, double time_s) JAWARI_REALTIME;

/// Bend that the string's sounding note should have now, without slides [semitones].
double bend_target(const InstrumentModel& model, const InstrumentState& state, std::size_t s) JAWARI_REALTIME;

/// Factor of the sound of a body on a moving bridge under the controls of `channel`.
double body_level(const InstrumentState& state, int channel) JAWARI_REALTIME;

/// Gains that a voice of string s should have under the controls of `channel`.
VoiceGains gain_targets(const InstrumentModel& model, const InstrumentState& state, std::size_t s,
                        int channel) JAWARI_REALTIME;

}  // namespace jawari
