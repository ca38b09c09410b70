#include "instrument_voice.h"

#include <algorithm>
#include <cmath>

#include "excitation.h"
#include "jawari/energy.h"
#include "jawari/render.h"
#include "kernels.h"

namespace jawari {
namespace {

/// Frames between two looks at a voice's energy.
constexpr std::uint64_t rest_check_frames = 64;

const StringModel& string_model(const InstrumentStringModel& string, const Voice& voice) {
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    return voice.phase == VoicePhase::Damped ? stopped.damped : stopped.ringing;
}

bool is_plucking(const InstrumentModel& model, const Voice& voice) {
    return voice.age + 1 < model.pluck_shape.size();
}

/// The finger's force over the coming frame: linear between the values at its boundaries.
void set_finger_force(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice) {
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    clear_excitation(stopped.ringing, voice.string);
    if (!is_plucking(model, voice)) return;
    const double* shape = model.pluck_shape.data() + voice.age;
    add_force(stopped.ringing, voice.string, stopped.pluck_row.data(), voice.pluck_force_N * shape[0],
              voice.pluck_force_N * (shape[1] - shape[0]) / static_cast<double>(model.steps_per_frame));
}

void finish(Voice& voice, Counters& finished) {
    accumulate(voice.string.counters, finished);
    voice.string.counters = {};
    voice.phase = VoicePhase::Idle;
    voice.fading = false;
}

double faded(const InstrumentModel& model, Voice& voice, double output) {
    output *= model.fade_shape[voice.fade_frame];
    voice.fade_frame += 1;
    return output;
}

bool has_ended(const InstrumentModel& model, const InstrumentStringModel& string, const Voice& voice) {
    if (voice.fading) return voice.fade_frame >= model.fade_shape.size();
    if (voice.age % rest_check_frames != 0 || is_plucking(model, voice)) return false;
    return voice_energy(string, voice) < string.stopped[voice.fret].rest_energy_J;
}

}  // namespace

void start_voice(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                 std::size_t fret, double velocity) JAWARI_REALTIME {
    const StoppedStringModel& stopped = string.stopped[fret];
    voice.phase = VoicePhase::Sounding;
    voice.fret = fret;
    voice.age = 0;
    voice.fading = false;
    voice.fade_frame = 0;
    voice.pluck_force_N = stopped.full_force_N * std::pow(velocity, model.height_exponent);
    reset(stopped.ringing, voice.string);
}

void damp_voice(const InstrumentStringModel& string, Voice& voice) JAWARI_REALTIME {
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    StringState& state = voice.string;
    for (std::size_t k = 0; k < stopped.ringing.stride; ++k) {
        state.velocity[k] = stopped.velocity_share[k] * state.velocity[k] +
                            stopped.displacement_share[k] * state.displacement[k];
    }
    notice_change(stopped.damped, state);
    voice.phase = VoicePhase::Damped;
}

void fade_voice(Voice& voice) JAWARI_REALTIME {
    if (voice.fading) return;
    voice.fading = true;
    voice.fade_frame = 0;
}

double advance_voice(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                     Counters& finished) JAWARI_REALTIME {
    const StringModel& coefficients = string_model(string, voice);
    set_finger_force(model, string, voice);
    advance_frame(coefficients, voice.string);
    voice.age += 1;
    double output = 0;
    kernels::row_products(1, voice.string.active_modes, coefficients.stride,
                          string.stopped[voice.fret].output_row.data(), voice.string.velocity.data(),
                          &output);
    if (voice.fading) output = faded(model, voice, output);
    if (has_ended(model, string, voice)) finish(voice, finished);
    return output;
}

double voice_energy(const InstrumentStringModel& string, const Voice& voice) JAWARI_REALTIME {
    return energy(string_model(string, voice), voice.string);
}

}  // namespace jawari
