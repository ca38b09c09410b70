#include "jawari/instrument/render.h"

#include <algorithm>
#include <array>

#include "base/assert.h"
#include "instrument/model/played_string.h"
#include "instrument/play/answering.h"
#include "instrument/play/control_targets.h"
#include "instrument/play/controls.h"
#include "instrument/play/coupled_frames.h"
#include "instrument/play/events.h"
#include "instrument/play/impacts.h"
#include "instrument/play/strokes.h"
#include "instrument/voice/body.h"
#include "instrument/voice/bridge_model.h"
#include "instrument/voice/coupled_voice.h"
#include "instrument/voice/end_run.h"
#include "instrument/voice/pickups.h"
#include "instrument/voice/voice.h"

namespace jawari {
namespace {

/// Frames that are computed in one go, string by string: a voice's numbers then stay in the cache.
constexpr std::size_t longest_run = control_frames;
static_assert(longest_run <= longest_voice_run);
static_assert(control_frames == longest_end_run);  // controls are followed where every run of a voice ends

/// The signals of a run.
struct Run {
    std::size_t frames = 0;
    std::array<double, longest_run> left{}, right{}, bridge_N{};
};

/// The same of one string.
struct StringRun {
    std::array<VoiceSignals, longest_run> signals{};
};

/// The voice through the run; frame by frame where impacts are logged.
void advance_run(const InstrumentModel& model, InstrumentState& state, std::size_t s, Voice& voice,
                 double smoothing, std::span<VoiceSignals> sums) {
    const InstrumentStringModel& string = string_of(model, state, s);
    if (!state.impacts.open) {
        advance_voice(model, string, voice, smoothing, state, sums);
        return;
    }
    for (std::size_t n = 0; n < sums.size() && voice.phase != VoicePhase::Idle; ++n) {
        const std::uint64_t impulses = voice.string.counters.impulses;
        advance_voice(model, string, voice, smoothing, state, sums.subspan(n, 1));
        if (voice.string.counters.impulses != impulses) log_impacts(string, voice, s, state.impacts);
    }
}

void advance_string(const InstrumentModel& model, InstrumentState& state, std::size_t s, double smoothing,
                    std::size_t frames, StringRun& run) {
    InstrumentStringState& string = state.strings[s];
    std::fill_n(run.signals.begin(), frames, VoiceSignals{});
    string.busy = 0;
    for (std::size_t v = 0; v < string.voices.size(); ++v) {
        Voice& voice = string.voices[v];
        if (voice.phase == VoicePhase::Idle) continue;
        advance_run(model, state, s, voice, smoothing, {run.signals.data(), frames});
        if (voice.phase != VoicePhase::Idle) {
            string.busy += 1;
        } else if (string.sounding == v) {
            string.sounding = no_voice;
        }
    }
}

/// What the string alone gives to the output: its pickups, and the mean of both sides of the body, which is
/// linear and so the sum of what each string drives it to. The first `sounding` frames of `one` are set.
void write_string(const InstrumentModel& model, InstrumentState& state, std::size_t s, std::size_t sounding,
                  const StringRun& one, double* out, std::size_t frames) {
    for (std::size_t i = 0; i < frames; ++i) {
        const VoiceSignals signals = i < sounding ? one.signals[i] : VoiceSignals{};
        out[i] = signals.pickups;
        if (state.string_bodies.empty()) continue;
        const StereoSample body = advance_body(model.body, state.string_bodies[s], signals.bridge_N);
        out[i] += (body.left + body.right) / 2;
    }
}

/// Frames until anything but the passing of time happens to a voice, at most `frames`. While a stroke waits,
/// frames are computed one by one.
std::size_t run_length(const InstrumentState& state, std::size_t frames) {
    if (state.waiting) return 1;
    const auto to_control = static_cast<std::size_t>(control_frames - state.frame % control_frames);
    return std::min(frames, to_control);
}

/// run.frames frames from sample n of the block on.
void advance(const InstrumentModel& model, InstrumentState& state, std::span<double* const> strings,
             std::size_t n, double smoothing, Run& run) {
    for (auto* signal : {&run.left, &run.right, &run.bridge_N}) std::fill_n(signal->begin(), run.frames, 0.0);
    if (bridge_moves(model)) {
        advance_coupled(model, state, {strings, n}, smoothing,
                        {run.frames, run.left.data(), run.right.data(), run.bridge_N.data()});
        return;
    }
    bool busy = false;
    StringRun one;
    const std::size_t heard =
        state.busy ? model.strings.size() : std::min(strings.size(), model.strings.size());
    for (std::size_t s = 0; s < heard; ++s) {
        const bool sounds = state.strings[s].busy > 0;
        if (sounds) advance_string(model, state, s, smoothing, run.frames, one);
        for (std::size_t i = 0; sounds && i < run.frames; ++i) {
            run.left[i] += one.signals[i].left;
            run.right[i] += one.signals[i].right;
            run.bridge_N[i] += one.signals[i].bridge_N;
        }
        if (s < strings.size())
            write_string(model, state, s, sounds ? run.frames : 0, one, strings[s] + n, run.frames);
        busy = busy || state.strings[s].busy > 0;
    }
    state.busy = busy;
    for (std::size_t i = 0; i < run.frames; ++i) {
        const StereoSample body = advance_body(model.body, state.body, run.bridge_N[i]);
        run.left[i] += body.left;
        run.right[i] += body.right;
    }
    state.frame += run.frames;
}

/// Calls act(string, voice) for voices on a moving bridge.
template <class Act>
void for_coupled_voices(const InstrumentModel& model, InstrumentState& state, Act act) {
    if (!bridge_moves(model) || !state.busy) return;
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        if (state.strings[s].busy == 0) continue;
        const InstrumentStringModel& string = string_of(model, state, s);
        for (Voice& voice : state.strings[s].voices) {
            if (voice.phase != VoicePhase::Idle) act(voice_model(string, voice), voice);
        }
    }
}

/// Before something happens to voices: their modes are those of now.
void settle_voices(const InstrumentModel& model, InstrumentState& state) {
    for_coupled_voices(model, state,
                       [](const StringModel& string, Voice& voice) { settle_run(string, voice); });
}

/// Calls sink(n, left, right) for every frame.
template <class Sink>
void render_frames(const InstrumentModel& model, InstrumentState& state,
                   std::span<const InstrumentEvent> events, std::span<double* const> strings,
                   std::size_t frames, Sink sink) {
    JAWARI_ASSERT(state.strings.size() == model.strings.size());
    const double smoothing = follow_share(model, 1, gain_follow_s);
    std::size_t next = 0;
    Run run;
    for (std::size_t n = 0; n < frames; n += run.frames) {
        std::size_t due = next;
        while (due < events.size() && events[due].frame <= n) ++due;
        if (due > next || state.waiting) settle_voices(model, state);
        start_pending_strokes(model, state);
        apply_events(model, state, events.subspan(next, due - next));
        next = due;
        if (state.frame % control_frames == 0) {
            if (state.busy) follow_controls(model, state);
            if (bridge_moves(model) && state.bridge.ringing) follow_answers(model, state);
        }
        const std::size_t end = next < events.size() ? std::min(frames, events[next].frame) : frames;
        run.frames = run_length(state, end - n);
        advance(model, state, strings, n, smoothing, run);
        for (std::size_t i = 0; i < run.frames; ++i) sink(n + i, run.left[i], run.right[i]);
    }
    if (next < events.size()) settle_voices(model, state);
    if (next < events.size()) start_pending_strokes(model, state);
    apply_events(model, state, events.subspan(next));
    for_coupled_voices(model, state,
                       [](const StringModel& string, Voice& voice) { show_run(string, voice); });
}

}  // namespace

void render_instrument(const InstrumentModel& model, InstrumentState& state,
                       std::span<const InstrumentEvent> events, const InstrumentOutput& output,
                       std::size_t frames) JAWARI_REALTIME {
    JAWARI_ASSERT(output.strings.empty() || output.strings.size() == model.strings.size());
    JAWARI_ASSERT(frames == 0 || (output.left != nullptr && output.right != nullptr));
    render_frames(model, state, events, output.strings, frames,
                  [&](std::size_t n, double left, double right) {
                      output.left[n] = left;
                      output.right[n] = right;
                  });
}

void render_instrument(const InstrumentModel& model, InstrumentState& state,
                       std::span<const InstrumentEvent> events, double* output,
                       std::size_t frames) JAWARI_REALTIME {
    render_frames(model, state, events, {}, frames,
                  [&](std::size_t n, double left, double right) { output[n] = (left + right) / 2; });
}

double string_energy(const InstrumentModel& model, InstrumentState& state,
                     std::size_t string) JAWARI_REALTIME {
    JAWARI_ASSERT(string < state.strings.size());
    double sum = 0;
    for (Voice& voice : state.strings[string].voices) {
        if (voice.phase != VoicePhase::Idle) sum += voice_energy(string_of(model, state, string), voice);
    }
    return sum;
}

double bridge_energy(const InstrumentModel& model, const InstrumentState& state) JAWARI_REALTIME {
    if (!bridge_moves(model)) return 0;
    return body_energy(model.bridge, state.bridge) + coupling_energy(model, state) + state.bridge.debt_J;
}

}  // namespace jawari
