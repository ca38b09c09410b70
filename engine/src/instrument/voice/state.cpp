#include "jawari/instrument/state.h"

#include <algorithm>

#include "instrument/voice/body.h"
#include "instrument/voice/voice.h"

namespace jawari {
namespace {

/// Of string s at any rung.
StringSizes largest_sizes(const InstrumentModel& model, std::size_t s) {
    StringSizes sizes = model.strings[s].sizes;
    for (const auto& rung : model.lower) sizes = larger(sizes, rung[s].sizes);
    return sizes;
}

InstrumentStringState make_string(const InstrumentModel& model, std::size_t s) {
    InstrumentStringState string;
    const StringSizes sizes = largest_sizes(model, s);
    const std::size_t voices = model.strings[s].stopped.size() == 1 ? 1 : voices_per_string;
    for (std::size_t v = 0; v < voices; ++v) string.voices.push_back(make_voice(sizes));
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
    for (std::size_t s = 0; s < model.strings.size(); ++s) state.strings.push_back(make_string(model, s));
    state.courses.resize(model.courses.size());
    state.channels.fill(neutral_channel());
    state.body = make_body_state(model.body);
    return state;
}

Counters contact_counters(const InstrumentState& state) {
    Counters sum = state.finished;
    for (const InstrumentStringState& string : state.strings) {
        for (const Voice& voice : string.voices) {
            if (voice.phase != VoicePhase::Idle) sum += voice.string.counters;
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
