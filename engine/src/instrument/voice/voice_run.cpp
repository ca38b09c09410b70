#include "instrument/voice/voice_run.h"

#include <algorithm>
#include <cmath>

#include "instrument/touch/touches.h"
#include "instrument/voice/bend.h"
#include "instrument/voice/bridge_model.h"

namespace jawari {
namespace {

/// Output frames between two looks at a voice's energy.
constexpr std::uint64_t rest_check_frames = 64;

void finish(Voice& voice, InstrumentState& state) {
    state.finished += voice.string.counters;
    voice.string.counters = {};
    voice.phase = VoicePhase::Idle;
    voice.fading = false;
    voice.slide.active = false;
    lift_all_touches(voice.touches);
    forget_bend(voice);
}

/// Fades move on by a frame.
void pass_fades(const InstrumentModel& model, Voice& voice) {
    if (voice.rise_frame < model.fade_shape.size()) voice.rise_frame += 1;
    if (voice.fading) voice.fade_frame += 1;
}

/// What a change of quality level has left goes on, and fades.
void add_remainder(const InstrumentModel& model, QualityRemainder& remainder, double& pickups,
                   double& bridge_N) {
    if (!remainder.active) return;
    const double gain = model.fade_shape[remainder.frame];
    pickups += gain * remainder.pickups;
    bridge_N += gain * remainder.bridge_N;
    remainder.frame += 1;
    remainder.active = remainder.frame < model.fade_shape.size();
}

/// `clock`: of the looks at its energy.
bool has_ended(const InstrumentModel& model, const InstrumentStringModel& string,
               const InstrumentState& state, Voice& voice, std::uint64_t clock) {
    if (voice.fading) return voice.fade_frame >= model.fade_shape.size();
    if (clock % rest_check_frames != 0 || voice.touches.exciter.phase != ExciterPhase::None) return false;
    const double rest_J = string.stopped[voice.fret].rest_energy_J;
    if (voice.phase == VoicePhase::Answering)
        return voice_energy(string, voice) < answer_energy_ratio * rest_J && !state.bridge.drives;
    return voice_energy(string, voice) < rest_J;
}

void follow(double target, double smoothing, double& value) {
    value += smoothing * (target - value);
}

void follow_gains(Voice& voice, double smoothing) {
    follow(voice.targets.level, smoothing, voice.gains.level);
    follow(voice.targets.left, smoothing, voice.gains.left);
    follow(voice.targets.right, smoothing, voice.gains.right);
    follow(voice.targets.body, smoothing, voice.gains.body);
    follow(voice.targets.mix, smoothing, voice.gains.mix);
}

}  // namespace

double fade_gain(const InstrumentModel& model, const Voice& voice) JAWARI_REALTIME {
    double gain = 1;
    if (voice.rise_frame < model.fade_shape.size()) gain -= model.fade_shape[voice.rise_frame];
    if (voice.fading) gain *= model.fade_shape[voice.fade_frame];
    return gain;
}

std::size_t frames_to_end(const VoiceRun& run) JAWARI_REALTIME {
    const Voice& voice = run.voice;
    if (voice.fading) return run.model.fade_shape.size() - voice.fade_frame;
    return static_cast<std::size_t>(rest_check_frames - voice.age % rest_check_frames);
}

void add_signals(VoiceRun& run, std::size_t n, std::uint64_t resets, VoiceSignals& sum) JAWARI_REALTIME {
    const auto& model = run.model;
    Voice& voice = run.voice;
    const StoppedStringModel& stopped = run.string.stopped[voice.fret];
    voice.age += 1;
    follow_gains(voice, run.smoothing);
    const double gain = voice.gains.level * fade_gain(model, voice);
    pass_fades(model, voice);
    double pickups = pickup_signal(model, stopped, run.readings, n, voice.gains.mix);
    double bridge_N = model.body.count > 0 ? bridge_force(stopped, run.readings, n) : 0.0;
    add_remainder(model, voice.remainder, pickups, bridge_N);
    VoiceSignals signals;
    signals.pickups = gain * pickups;
    signals.left = voice.gains.left * signals.pickups;
    signals.right = voice.gains.right * signals.pickups;
    signals.bridge_N = gain * voice.gains.body * bridge_N;
    const bool finite = std::isfinite(signals.left + signals.right + signals.bridge_N);
    if (!finite || voice.string.counters.nonfinite_resets != resets) {
        // The string is at rest, but what has lost it may be a hand, a hammer or a gain: the voice ends, and
        // the next note starts with nothing of it.
        voice.string.counters.nonfinite_resets = resets + 1;
        finish(voice, run.state);
        return;
    }
    sum.pickups += signals.pickups;
    sum.left += signals.left;
    sum.right += signals.right;
    sum.bridge_N += signals.bridge_N;
    // On a moving bridge the instrument's frames count: where runs end, a voice's modes are known.
    const std::uint64_t clock = bridge_moves(model) ? run.frame + n + 1 : voice.age;
    if (has_ended(model, run.string, run.state, voice, clock)) finish(voice, run.state);
}

}  // namespace jawari
