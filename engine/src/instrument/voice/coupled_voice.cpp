#include "instrument/voice/coupled_voice.h"

#include <cmath>

#include "instrument/model/played_string.h"
#include "instrument/touch/bridge_end.h"
#include "instrument/voice/bridge_frame.h"
#include "instrument/voice/pickups.h"
#include "instrument/voice/voice_run.h"

namespace jawari {
namespace {

BridgeEndModel end_model(const StoppedStringModel& stopped, const Voice& voice) {
    return {stopped.end_row.data(), stopped.end_rest_N, voice.end.stiffness_N_per_m,
            voice.bend.active ? -1.0 : stopped.end_root, stopped.end_strength};
}

Voice& voice_of(InstrumentState& state, const VoiceOnBridge& on_bridge) {
    return state.strings[on_bridge.string].voices[on_bridge.voice];
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
    const BridgeEnd before = voice.end;
    const double growth = voice.bend.active ? voice.bend.growth : 1.0;
    voice.end.stiffness_N_per_m =
        voice.bend.active ? voice.bend.bridge_stiffness_N_per_m : stopped.bridge_stiffness_N_per_m;
    voice.end.weight = string.own_level * growth * fade_gain(model, voice);
    begin_end_frame(voice_model(string, voice), voice.string, voice.touches, end_model(stopped, voice),
                    on_bridge.frame);
    const double bridge_m = state.bridge.under_start[on_bridge.string];
    const double start_N = on_bridge.frame.start_N;
    const double given_J = coupling_energy(voice.end.weight, bridge_m, start_N, voice.end.stiffness_N_per_m) -
                           coupling_energy(before.weight, bridge_m, before.force_N, before.stiffness_N_per_m);
    if (std::isfinite(given_J)) state.work.couplings_J += given_J;
    const bool finite = std::isfinite(on_bridge.frame.force_N + on_bridge.frame.stiffness_N_per_m +
                                      on_bridge.frame.by_exciter);
    on_bridge.weight = finite ? voice.end.weight : 0.0;
    if (finite) return;
    on_bridge.frame.force_N = on_bridge.frame.by_exciter = 0;
    on_bridge.frame.stiffness_N_per_m = 1;
}

void end_coupled_frame(const InstrumentModel& model, InstrumentState& state, VoiceOnBridge& on_bridge,
                       double smoothing, VoiceSignals& sum) JAWARI_REALTIME {
    const InstrumentStringModel& string = string_of(model, state, on_bridge.string);
    Voice& voice = voice_of(state, on_bridge);
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    const StringModel& coefficients = voice_model(string, voice);
    const std::uint64_t resets = voice.string.counters.nonfinite_resets;
    const EndForce force = end_end_frame(coefficients, voice.string, voice.touches, end_model(stopped, voice),
                                         on_bridge.frame, on_bridge.zeta_m, state.work);
    const bool lost = voice.string.counters.nonfinite_resets != resets;
    on_bridge.left_N = lost ? 0.0 : force.force_N - force.expected_N;
    voice.end.force_N = lost ? 0.0 : force.force_N;
    OutputReadings readings;  // NOLINT(cppcoreguidelines-pro-type-member-init): set as far as it is read
    set_output_readings(model, stopped, readings);
    read_outputs(voice.string, 0, readings);
    VoiceRun run{model, string, voice, smoothing, state, readings};
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
