#include "instrument_control.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "instrument_bend.h"
#include "instrument_hand.h"
#include "instrument_strings.h"
#include "instrument_voice.h"

namespace jawari {
namespace {

/// A bend that is this close to its target arrives [semitones].
constexpr double close_enough = 1e-3;

const ChannelState& channel_of(const InstrumentState& state, int channel) {
    return state.channels[static_cast<std::size_t>(channel)];
}

double vibrato(const InstrumentModel& model, const InstrumentState& state, const ChannelState& channel) {
    const double depth = parameter_of(channel, ParameterId::VibratoDepth);
    if (depth == 0) return 0;
    const double t = static_cast<double>(state.frame) / model.output_rate_hz;
    const double turns = t * parameter_of(channel, ParameterId::VibratoRate);
    return depth * std::sin(2 * std::numbers::pi * (turns - std::floor(turns)));
}

void follow_bend(const InstrumentModel& model, InstrumentState& state, std::size_t s, Voice& voice) {
    const StoppedStringModel& stopped = string_of(model, state, s).stopped[voice.fret];
    const double wanted = bend_target(model, state, s);
    double& target = voice.bend.target;
    target += follow_share(model, control_frames, bend_follow_s) * (wanted - target);
    if (!(std::abs(wanted - target) >= close_enough)) target = wanted;  // also if it is no number
    double semitones = target;
    if (voice.slide.active) {
        SlideState& slide = voice.slide;
        slide.frame = std::min(slide.frame + control_frames, slide.frames);
        const double gone = static_cast<double>(slide.frame) / static_cast<double>(slide.frames);
        semitones += slide.begun + gone * (slide.semitones - slide.begun);
    }
    set_bend(stopped, voice, semitones, state.work);
    if (voice.slide.active && voice.slide.frame >= voice.slide.frames) arrive(model, state, s);
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

VoiceGains gain_targets(const InstrumentModel& model, const InstrumentState& state, std::size_t s,
                        int channel) JAWARI_REALTIME {
    const InstrumentStringModel& string = string_of(model, state, s);
    const ChannelState& controls = channel_of(state, channel);
    const double pan = std::clamp(string.pan + parameter_of(controls, ParameterId::Pan), -1.0, 1.0);
    const double angle = (pan + 1) * std::numbers::pi / 4;
    VoiceGains gains;
    gains.level = string.level * parameter_of(controls, ParameterId::Volume) *
                  parameter_of(controls, ParameterId::Expression);
    gains.left = std::numbers::sqrt2 * std::cos(angle);
    gains.right = std::numbers::sqrt2 * std::sin(angle);
    gains.body = parameter_of(controls, ParameterId::BodyMix);
    gains.mix = parameter_of(controls, ParameterId::PickupMix);
    return gains;
}

void follow_controls(const InstrumentModel& model, InstrumentState& state) JAWARI_REALTIME {
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        InstrumentStringState& string = state.strings[s];
        if (string.busy == 0) continue;
        for (Voice& voice : string.voices) {
            if (voice.phase != VoicePhase::Idle) voice.targets = gain_targets(model, state, s, voice.channel);
        }
        if (string.sounding == no_voice) continue;
        Voice& sounding = string.voices[string.sounding];
        const ChannelState& controls = channel_of(state, sounding.channel);
        press_palm(model, string_of(model, state, s), sounding, parameter_of(controls, ParameterId::PalmMute),
                   parameter_of(controls, ParameterId::PalmPosition));
        follow_bend(model, state, s, sounding);
    }
}

}  // namespace jawari
