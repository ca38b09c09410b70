#include "jawari/instrument_state.h"

#include <algorithm>

#include "instrument_voice.h"

namespace jawari {

InstrumentState make_instrument_state(const InstrumentModel& model) {
    InstrumentState state;
    state.strings.resize(model.strings.size());
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        for (Voice& voice : state.strings[s].voices) {
            voice.string = make_string_state(model.strings[s].stopped[0].ringing);
        }
    }
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
    return std::all_of(state.strings.begin(), state.strings.end(), [](const InstrumentStringState& string) {
        return !string.pending.active &&
               std::all_of(string.voices.begin(), string.voices.end(),
                           [](const Voice& voice) { return voice.phase == VoicePhase::Idle; });
    });
}

}  // namespace jawari
