#include "instrument/voice/coupled_voice.h"

#include <cmath>

#include "instrument/model/played_string.h"
#include "instrument/touch/bridge_end.h"
#include "instrument/voice/bridge_frame.h"
#include "instrument/voice/end_run.h"
#include "instrument/voice/pickups.h"
#include "instrument/voice/voice_run.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

BridgeEndModel end_model(const StoppedStringModel& stopped, const Voice& voice) {
    return {stopped.end_row.data(), stopped.end_rest_N, voice.end.stiffness_N_per_m,
            voice.bend.active ? -1.0 : stopped.end_root, stopped.end_strength};
}

Voice& voice_of(InstrumentState& state, const VoiceOnBridge& on_bridge) {
    return state.strings[on_bridge.string].voices[on_bridge.voice];
}

double weight_of(const InstrumentModel& model, const InstrumentStringModel& string, const Voice& voice) {
    const double growth = voice.bend.active ? voice.bend.growth : 1.0;
    return string.own_level * growth * fade_gain(model, voice);
}

/// Output frames until controls are followed, where every run ends.
std::size_t frames_left(const InstrumentState& state) {
    return static_cast<std::size_t>(longest_end_run - state.frame % longest_end_run);
}

/// A string's force on the bridge that the body hears is that of its middle displacement, as X is.
void read_middle(const InstrumentModel& model, const StoppedStringModel& stopped, const StringModel& string,
                 const Voice& voice, OutputReadings& readings) {
    if (model.body.count == 0) return;
    readings.values[readings.count - 1][0] -=
        string.shape->step_s / 2 *
        kernels::row_product(voice.string.active_modes, stopped.bridge_row.data(),
                             voice.string.velocity.data());
}

/// What the coupling of a voice that begins a frame has been given since the last one's end.
void meter_coupling(const InstrumentModel& model, InstrumentState& state, const VoiceOnBridge& on_bridge,
                    const BridgeEnd& before, const BridgeEnd& now) {
    const bool same = now.weight == before.weight && now.stiffness_N_per_m == before.stiffness_N_per_m &&
                      on_bridge.frame.start_N == before.force_N;
    if (same) return;
    const double bridge_m = bridge_under(model.bridge, state.bridge, on_bridge.string);
    const double given_J =
        coupling_energy(now.weight, bridge_m, on_bridge.frame.start_N, now.stiffness_N_per_m) -
        coupling_energy(before.weight, bridge_m, before.force_N, before.stiffness_N_per_m);
    if (std::isfinite(given_J)) state.work.couplings_J += given_J;
}

}  // namespace

void leave_bridge(const InstrumentModel& model, InstrumentState& state,
                  const VoiceOnBridge& on_bridge) JAWARI_REALTIME {
    Voice& voice = voice_of(state, on_bridge);
    if (voice.phase != VoicePhase::Idle) return;
    const double held_J =
        coupling_energy(voice.end.weight, bridge_under(model.bridge, state.bridge, on_bridge.string),
                        voice.end.force_N, voice.end.stiffness_N_per_m);
    if (std::isfinite(held_J)) state.work.couplings_J -= held_J;
    voice.end = {};
}

void begin_coupled_frame(const InstrumentModel& model, InstrumentState& state,
                         VoiceOnBridge& on_bridge) JAWARI_REALTIME {
    const InstrumentStringModel& string = string_of(model, state, on_bridge.string);
    Voice& voice = voice_of(state, on_bridge);
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    const StringModel& coefficients = voice_model(string, voice);
    const BridgeEnd before = voice.end;
    voice.end.stiffness_N_per_m =
        voice.bend.active ? voice.bend.bridge_stiffness_N_per_m : stopped.bridge_stiffness_N_per_m;
    voice.end.weight = weight_of(model, string, voice);
    const BridgeEndModel end = end_model(stopped, voice);
    const EndFlyer flyer{model, stopped, coefficients, end};
    on_bridge.in_run =
        goes_on_in_run(voice) || (!state.waiting && begin_end_run(flyer, voice, frames_left(state)));
    if (on_bridge.in_run) {
        answer_in_run(voice.run, end, on_bridge.frame);
    } else {
        begin_end_frame(coefficients, voice.string, voice.touches, end, on_bridge.frame);
    }
    meter_coupling(model, state, on_bridge, before, voice.end);
    const bool finite = std::isfinite(on_bridge.frame.force_N + on_bridge.frame.stiffness_N_per_m +
                                      on_bridge.frame.by_exciter);
    on_bridge.weight = finite ? voice.end.weight : 0.0;
    if (finite) return;
    on_bridge.frame.force_N = on_bridge.frame.by_exciter = 0;
    on_bridge.frame.stiffness_N_per_m = 1;
}

bool goes_on_steadily(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                      VoiceOnBridge& on_bridge) JAWARI_REALTIME {
    if (!goes_on_in_run(voice) || voice.run.passed == 0 || voice.fading) return false;
    if (voice.end.weight != weight_of(model, string, voice)) return false;
    const VoiceGains& gains = voice.gains;
    const VoiceGains& targets = voice.targets;
    const double sum = gains.level + gains.left + gains.right + gains.body + gains.mix + targets.level +
                       targets.left + targets.right + targets.body + targets.mix;
    if (!std::isfinite(sum)) return false;
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    answer_in_run(voice.run, end_model(stopped, voice), on_bridge.frame);
    on_bridge.weight = voice.end.weight;
    on_bridge.rest_N = stopped.end_rest_N;
    return true;
}

void end_coupled_frame(const InstrumentModel& model, InstrumentState& state, VoiceOnBridge& on_bridge,
                       double smoothing, VoiceSignals& sum) JAWARI_REALTIME {
    const InstrumentStringModel& string = string_of(model, state, on_bridge.string);
    Voice& voice = voice_of(state, on_bridge);
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    const StringModel& coefficients = voice_model(string, voice);
    const BridgeEndModel end = end_model(stopped, voice);
    OutputReadings readings;  // NOLINT(cppcoreguidelines-pro-type-member-init): set as far as it is read
    const std::uint64_t resets = voice.string.counters.nonfinite_resets;
    if (on_bridge.in_run && may_pass_in_run(voice.run, on_bridge.zeta_m)) {
        pass_in_run(coefficients, voice, on_bridge.zeta_m);
        on_bridge.left_N = 0;
        voice.end.force_N = voice.run.readings[voice.run.passed] - end.rest_N;
        read_run(voice.run, voice.run.passed, 1, readings);
        if (voice.run.passed == voice.run.frames) settle_run(coefficients, voice);
    } else {
        if (on_bridge.in_run) {
            give_up_run(coefficients, voice, on_bridge.zeta_m);
            begin_end_frame(coefficients, voice.string, voice.touches, end, on_bridge.frame);
        }
        note_end(voice.run, on_bridge.zeta_m);
        const EndForce force = end_end_frame(coefficients, voice.string, voice.touches, end, on_bridge.frame,
                                             on_bridge.zeta_m, state.work);
        on_bridge.left_N = force.force_N - force.expected_N;
        voice.end.force_N = force.force_N;
        set_output_readings(model, stopped, readings);
        read_outputs(voice.string, 0, readings);
        read_middle(model, stopped, coefficients, voice, readings);
    }
    if (voice.string.counters.nonfinite_resets != resets) on_bridge.left_N = voice.end.force_N = 0;
    VoiceRun run{model, string, voice, smoothing, state, readings, state.frame};
    add_signals(run, 0, resets, sum);
}

double coupling_energy(const InstrumentModel& model, const InstrumentState& state) JAWARI_REALTIME {
    double sum = 0;
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        const InstrumentStringModel& string = string_of(model, state, s);
        const double bridge_m = bridge_under(model.bridge, state.bridge, s);
        for (const Voice& voice : state.strings[s].voices) {
            if (voice.phase == VoicePhase::Idle || voice.end.weight == 0) continue;
            const double force_N = end_force(voice_model(string, voice), voice.string,
                                             end_model(string.stopped[voice.fret], voice));
            sum += coupling_energy(voice.end.weight, bridge_m, force_N, voice.end.stiffness_N_per_m);
        }
    }
    return sum;
}

}  // namespace jawari
