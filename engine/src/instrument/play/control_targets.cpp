#include "instrument/play/control_targets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "instrument/model/played_string.h"

namespace jawari {
namespace {

double vibrato(const InstrumentModel& model, const InstrumentState& state, const ChannelState& channel) {
    const double depth = parameter_of(channel, ParameterId::VibratoDepth);
    if (depth == 0) return 0;
    const double t = static_cast<double>(state.frame) / model.output_rate_hz;
    const double turns = t * parameter_of(channel, ParameterId::VibratoRate);
    return depth * std::sin(2 * std::numbers::pi * (turns - std::floor(turns)));
}

}  // namespace

double follow_share(const InstrumentModel& model, double frames, double time_s) JAWARI_REALTIME {
    return -std::expm1(-frames / (time_s * model.output_rate_hz));
}

double bend_target(const InstrumentModel& model, const InstrumentState& state,
                   std::size_t s) JAWARI_REALTIME {
    const HeldNote& held = state.courses[string_of(model, state, s).course].held;
    const ChannelState& channel = channel_of(state, held.channel);
    const double bend = std::isnan(held.bend) ? channel.bend : held.bend;
    const double pressure = std::isnan(held.pressure) ? channel.pressure : held.pressure;
    return bend + pressure * model.hand.pressure_semitones + vibrato(model, state, channel);
}

double body_level(const InstrumentState& state, int channel) JAWARI_REALTIME {
    const ChannelState& controls = channel_of(state, channel);
    return parameter_of(controls, ParameterId::Volume) * parameter_of(controls, ParameterId::Expression) *
           parameter_of(controls, ParameterId::BodyMix);
}

VoiceGains gain_targets(const InstrumentModel& model, const InstrumentState& state, std::size_t s,
                        int channel) JAWARI_REALTIME {
    const InstrumentStringModel& string = string_of(model, state, s);
    const ChannelState& controls = channel_of(state, channel);
    // What still rings of another channel's note keeps nothing of the one that has taken its string.
    const HeldNote& held = state.courses[string.course].held;
    const HeldNote neutral{};
    const HeldNote& own = held.channel == channel ? held : neutral;
    const double pan = std::clamp(string.pan + parameter_of(controls, ParameterId::Pan) + own.pan, -1.0, 1.0);
    const double angle = (pan + 1) * std::numbers::pi / 4;
    VoiceGains gains;
    gains.level = string.level * parameter_of(controls, ParameterId::Volume) *
                  parameter_of(controls, ParameterId::Expression) * own.level;
    gains.left = std::numbers::sqrt2 * std::cos(angle);
    gains.right = std::numbers::sqrt2 * std::sin(angle);
    gains.body = parameter_of(controls, ParameterId::BodyMix);
    gains.mix = parameter_of(controls, ParameterId::PickupMix);
    return gains;
}

}  // namespace jawari
