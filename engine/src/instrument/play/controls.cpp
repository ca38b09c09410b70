#include "instrument/play/controls.h"

#include <algorithm>
#include <cmath>

#include "instrument/play/control_targets.h"
#include "instrument/play/strokes.h"
#include "instrument/voice/bend.h"
#include "instrument/voice/hands.h"
#include "instrument/voice/voice.h"

namespace jawari {
namespace {

/// A bend that is this close to its target arrives [semitones].
constexpr double close_enough = 1e-3;

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

void follow_controls(const InstrumentModel& model, InstrumentState& state) JAWARI_REALTIME {
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        InstrumentStringState& string = state.strings[s];
        if (string.busy == 0) continue;
        for (Voice& voice : string.voices) {
            if (voice.phase != VoicePhase::Idle) voice.targets = gain_targets(model, state, s, voice.channel);
        }
        if (string.sounding == no_voice) continue;
        Voice& sounding = string.voices[string.sounding];
        const ChannelState& controls = state.channels[static_cast<std::size_t>(sounding.channel)];
        press_palm(model, string_of(model, state, s), sounding, parameter_of(controls, ParameterId::PalmMute),
                   parameter_of(controls, ParameterId::PalmPosition));
        follow_bend(model, state, s, sounding);
    }
}

}  // namespace jawari
