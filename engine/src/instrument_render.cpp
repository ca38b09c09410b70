#include "jawari/instrument_render.h"

#include <algorithm>

#include "instrument_notes.h"
#include "instrument_voice.h"

namespace jawari {
namespace {

double advance_strings(const InstrumentModel& model, InstrumentState& state) {
    double sum = 0;
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        InstrumentStringState& string = state.strings[s];
        for (std::size_t v = 0; v < voices_per_string; ++v) {
            if (string.voices[v].phase == VoicePhase::Idle) continue;
            sum += advance_voice(model, model.strings[s], string.voices[v], state.finished);
            if (string.voices[v].phase == VoicePhase::Idle && string.sounding == v)
                string.sounding = no_voice;
        }
    }
    return sum;
}

}  // namespace

void render_instrument(const InstrumentModel& model, InstrumentState& state,
                       std::span<const InstrumentEvent> events, const InstrumentOutput& output,
                       std::size_t frames) JAWARI_REALTIME {
    render_instrument(model, state, events, output.left, frames);
    std::copy_n(output.left, frames, output.right);
}

void render_instrument(const InstrumentModel& model, InstrumentState& state,
                       std::span<const InstrumentEvent> events, double* output,
                       std::size_t frames) JAWARI_REALTIME {
    std::size_t next = 0;
    for (std::size_t n = 0; n < frames; ++n) {
        start_pending_notes(model, state);
        while (next < events.size() && events[next].frame <= n) apply_event(model, state, events[next++]);
        output[n] = advance_strings(model, state);
        state.frame += 1;
    }
    if (next < events.size()) start_pending_notes(model, state);
    while (next < events.size()) apply_event(model, state, events[next++]);
}

}  // namespace jawari
