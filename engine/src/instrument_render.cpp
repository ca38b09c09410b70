#include "jawari/instrument_render.h"

#include <algorithm>

#include "instrument_body.h"
#include "instrument_control.h"
#include "instrument_notes.h"
#include "instrument_strings.h"
#include "instrument_voice.h"

namespace jawari {
namespace {

VoiceSignals advance_string(const InstrumentModel& model, InstrumentState& state, std::size_t s,
                            double smoothing) {
    InstrumentStringState& string = state.strings[s];
    VoiceSignals sum;
    std::size_t busy = 0;
    for (std::size_t v = 0; v < string.voices.size(); ++v) {
        Voice& voice = string.voices[v];
        if (voice.phase == VoicePhase::Idle) continue;
        const VoiceSignals signals = advance_voice(model, model.strings[s], voice, smoothing, state);
        sum.pickups += signals.pickups;
        sum.left += signals.left;
        sum.right += signals.right;
        sum.bridge_N += signals.bridge_N;
        if (voice.phase != VoicePhase::Idle) {
            ++busy;
        } else if (string.sounding == v) {
            string.sounding = no_voice;
        }
    }
    string.busy = busy;
    return sum;
}

StereoSample advance(const InstrumentModel& model, InstrumentState& state, std::span<double* const> strings,
                     std::size_t n, double smoothing) {
    if (state.busy && state.frame % control_frames == 0) follow_controls(model, state);
    StereoSample sample;
    double bridge_N = 0;
    bool busy = false;
    const std::size_t heard =
        state.busy ? model.strings.size() : std::min(strings.size(), model.strings.size());
    for (std::size_t s = 0; s < heard; ++s) {
        VoiceSignals signals;
        if (state.strings[s].busy > 0) signals = advance_string(model, state, s, smoothing);
        if (s < strings.size()) strings[s][n] = signals.pickups;
        sample.left += signals.left;
        sample.right += signals.right;
        bridge_N += signals.bridge_N;
        busy = busy || state.strings[s].busy > 0;
    }
    state.busy = busy;
    const StereoSample body = advance_body(model.body, state.body, bridge_N);
    sample.left += body.left;
    sample.right += body.right;
    state.frame += 1;
    return sample;
}

/// Calls sink(n, sample) for every frame.
template <class Sink>
void render_frames(const InstrumentModel& model, InstrumentState& state,
                   std::span<const InstrumentEvent> events, std::span<double* const> strings,
                   std::size_t frames, Sink sink) {
    const double smoothing = follow_share(model, 1, gain_follow_s);
    std::size_t next = 0;
    for (std::size_t n = 0; n < frames; ++n) {
        start_pending_strokes(model, state);
        while (next < events.size() && events[next].frame <= n) apply_event(model, state, events[next++]);
        sink(n, advance(model, state, strings, n, smoothing));
    }
    if (next < events.size()) start_pending_strokes(model, state);
    while (next < events.size()) apply_event(model, state, events[next++]);
}

}  // namespace

void render_instrument(const InstrumentModel& model, InstrumentState& state,
                       std::span<const InstrumentEvent> events, const InstrumentOutput& output,
                       std::size_t frames) JAWARI_REALTIME {
    render_frames(model, state, events, output.strings, frames, [&](std::size_t n, StereoSample sample) {
        output.left[n] = sample.left;
        output.right[n] = sample.right;
    });
}

void render_instrument(const InstrumentModel& model, InstrumentState& state,
                       std::span<const InstrumentEvent> events, double* output,
                       std::size_t frames) JAWARI_REALTIME {
    render_frames(model, state, events, {}, frames,
                  [&](std::size_t n, StereoSample sample) { output[n] = (sample.left + sample.right) / 2; });
}

double string_energy(const InstrumentModel& model, InstrumentState& state, std::size_t s) JAWARI_REALTIME {
    double sum = 0;
    for (Voice& voice : state.strings[s].voices) {
        if (voice.phase != VoicePhase::Idle) sum += voice_energy(model.strings[s], voice);
    }
    return sum;
}

}  // namespace jawari
