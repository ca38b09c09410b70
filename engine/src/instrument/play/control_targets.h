// What a string's bend and gains should be now, given its channel's controls. Pure functions.
#pragma once

#include <cstddef>

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

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

}  // namespace jawari
