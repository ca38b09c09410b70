#include "jawari/instrument_state.h"

#include <algorithm>

#include "instrument_body.h"
#include "instrument_voice.h"

namespace jawari {
namespace {

InstrumentStringState make_string(const InstrumentStringModel& model) {
    InstrumentStringState string;
    const std::size_t voices = model.stopped.size() == 1 ? 1 : voices_per_string;
    for (std::size_t v = 0; v < voices; ++v) string.voices.push_back(make_voice(model));
    string.scratch.assign(model.sizes.stride, 0.0);
    return string;
}

ChannelState neutral_channel() {
    ChannelState channel;
    for (const ParameterDeclaration& parameter : parameter_table())
        channel.parameters[static_cast<std::size_t>(parameter.id)] = parameter.neutral;
    return channel;
}

}  // namespace

InstrumentState make_instrument_state(const InstrumentModel& model) {
    InstrumentState state;
    state.play = model.play;
    for (const InstrumentStringModel& string : model.strings) state.strings.push_back(make_string(string));
    state.courses.resize(model.courses.size());
    state.channels.fill(neutral_channel());
    state.body = make_body_state(model.body);
    return state;
}

Counters contact_counters(const InstrumentState& state) {
    Counters sum = state.finished;
    for (const InstrumentStringState& string : state.strings) {
        for (const Voice& voice : string.voices) {
            if (voice.phase != VoicePhase::Idle) accumulate(voice.string.counters, sum);
        }
    }
    return sum;
}

bool at_rest(const InstrumentState& state) noexcept {
    return !state.body.ringing &&
           std::all_of(state.strings.begin(), state.strings.end(), [](const InstrumentStringState& string) {
               return !string.pending.active &&
                      std::all_of(string.voices.begin(), string.voices.end(),
                                  [](const Voice& voice) { return voice.phase == VoicePhase::Idle; });
           });
}

}  // namespace jawari
