#include "instrument/voice/voice.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "instrument/touch/exciters.h"
#include "instrument/touch/touches.h"
#include "instrument/voice/bend.h"
#include "instrument/voice/hands.h"
#include "instrument/voice/pickups.h"
#include "instrument/voice/voice_run.h"
#include "jawari/scene/energy.h"
#include "jawari/scene/render.h"
#include "string/broad_phase/gap_bounds.h"
#include "string/frame/frame.h"
#include "string/kernels/mode_sums.h"
#include "string/state/excitation.h"

namespace jawari {
namespace {

/// A finger that comes down on a ringing string has at least this share of its wave impedance.
constexpr double finger_share = 0.5;
/// A finger's damping comes and leaves in this part of the rise each.
constexpr std::uint64_t damping_eases = 4;

/// A negative `action` raises what the string clears up to this height, just below the rest line [m].
constexpr double highest_lowered_m = -1e-5;

void lower_obstacles(const StoppedStringModel& stopped, StringState& string, double action_m) {
    if (action_m == 0) return;
    for (const std::uint32_t c : stopped.action_contacts) {
        // The string rests on what lifts it; only what it clears may move, and never to its rest line.
        const double height = stopped.string.shape->contact_height[c];
        string.contact.height[c] = std::min(height - action_m, std::max(height, highest_lowered_m));
        string.contact.height_before[c] = string.contact.height[c];
    }
    notice_change(stopped.string, string);
}

/// A finger lifts as high from any place: its force follows the compliance x (L - x) of the string there.
double force_at(const StoppedStringModel& stopped, double full_force_N, double described_x, double x) {
    const double L = stopped.string.shape->length_m;
    return full_force_N * described_x * (L - described_x) / (x * (L - x));
}

/// A tangent's movement takes at least this many output frames: its force, which follows the movement's
/// acceleration, is held over each of them.
constexpr std::uint64_t shortest_tangent_frames = 4;

/// Another string is about to lie on the voice's end.
void begin_anew(EndRun& run) {
    run.frames = run.passed = 0;
    run.not_before = 0;
    run.still_m = run.swing_m = 0;
    run.shown = false;
    run.outdated = true;
}

/// A stroke on one voice.
struct Strike {
    const InstrumentModel& model;
    const InstrumentStringModel& string;
    Voice& voice;
    const Stroke& stroke;
    double x_m = 0;            ///< where, from the start of the speaking length; 0 for tangents
    double described_x_m = 0;  ///< where the description has it
};

/// Factor of an exciter's times.
double time_factor(const Strike& strike) {
    const double exponent = strike.model.exciters[strike.stroke.exciter].time_exponent;
    return std::pow(strike.stroke.velocity, -exponent) / strike.stroke.hardness;
}

void strike_with(const FingerDescription& finger, const Strike& strike) {
    const auto& [model, string, voice, stroke, x, described_x] = strike;
    const ExciterDescription& exciter = model.exciters[stroke.exciter];
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    const double times = time_factor(strike);
    const double force = force_at(stopped, stopped.full_force_N[stroke.exciter], described_x, x) *
                         std::pow(stroke.velocity, finger.height_exponent);
    const std::uint64_t rise = frames_of(finger.rise_s * times, model.output_rate_hz);
    begin_finger(voice_model(string, voice), voice.touches.exciter, x, exciter.width_m, force, rise,
                 frames_of(finger.release_s * times, model.output_rate_hz));
    if (finger.roughness > 0) {
        voice.touches.exciter.roughness = finger.roughness;
        voice.touches.exciter.seed = next_noise(voice_model(string, voice), voice.touches);
    }
    const double least = voice.age > 0 ? finger_share * stopped.wave_impedance_kg_per_s : 0.0;
    const double damping = std::max(least, finger.damping_kg_per_s);
    if (damping == 0) return;
    // It has left when the release begins: a finger that slips off holds nothing.
    const std::uint64_t ease = std::max<std::uint64_t>(1, rise / damping_eases);
    lay_touch(voice_model(string, voice), voice.string, voice.touches, TouchSlot::Finger,
              {.x_m = x,
               .width_m = exciter.width_m,
               .damping_kg_per_s = damping,
               .frames = rise + 1 - ease,
               .ease_frames = static_cast<double>(ease)});
}

void strike_with(const HammerDescription& hammer, const Strike& strike) {
    const Stroke& stroke = strike.stroke;
    Voice& voice = strike.voice;
    const double speed = strike.string.excitation * hammer.full_speed_m_per_s *
                         std::pow(stroke.velocity, hammer.speed_exponent);
    begin_hammer(voice_model(strike.string, voice), voice.string, voice.touches.exciter, strike.x_m,
                 strike.model.exciters[stroke.exciter].width_m, hammer, speed, stroke.hardness);
}

void strike_with(const TangentDescription& tangent, const Strike& strike) {
    Voice& voice = strike.voice;
    const double height = strike.string.excitation * tangent.full_height_m *
                          std::pow(strike.stroke.velocity, tangent.height_exponent);
    const std::uint64_t rise = frames_of(tangent.rise_s * time_factor(strike), strike.model.output_rate_hz);
    begin_tangent(voice_model(strike.string, voice), voice.touches.exciter, height,
                  std::max(shortest_tangent_frames, rise));
}

/// A frame under hands or an exciter.
void pass_touched(const StringModel& coefficients, VoiceRun& run, std::size_t n) {
    Voice& voice = run.voice;
    apply_touches(coefficients, voice.string, voice.touches);
    const std::uint64_t impulses = voice.string.counters.impulses;
    advance_frame(coefficients, voice.string);
    const bool struck = voice.string.counters.impulses != impulses;
    meter_touches(coefficients, voice.string, voice.touches, struck, run.state.work);
    read_outputs(voice.string, n, run.readings);
}

/// The same of a string that nothing can strike and that only the body hears.
void fly_touched_frame(const StringModel& coefficients, VoiceRun& run, TouchedRun& touched, std::size_t n) {
    Voice& voice = run.voice;
    run.readings.values[0][n] =
        fly_touched(coefficients, voice.string, voice.touches, touched, run.state.work);
}

/// Whether fly_touched_frame() does what pass_touched() does.
bool only_flies(const StringModel& coefficients, const VoiceRun& run) {
    return run.readings.count == 1 && !run.readings.rows[0].of_velocity &&
           flies_always(coefficients, run.voice.string);
}

/// Frames of a string that nothing touches, at most `frames`: as many at once as contacts are known to stay
/// open. Returns how many there were.
std::size_t pass_untouched(const StringModel& coefficients, VoiceRun& run, std::size_t n,
                           std::size_t frames) {
    StringState& string = run.voice.string;
    clear_excitation(string);
    const BroadPhaseAnswer answer = plan_frames(coefficients, string);
    if (answer == BroadPhaseAnswer::Planned) {
        const auto planned = static_cast<std::size_t>(planned_frames(string));
        const std::size_t flying = std::min({planned, frames, frames_to_end(run)});
        fly_ahead(coefficients, string, run.readings.span(), ReadAt::End, n, flying);
        return flying;
    }
    cross_frame(coefficients, string, answer);
    read_outputs(string, n, run.readings);
    return 1;
}

}  // namespace

Voice make_voice(const StringSizes& sizes) {
    Voice voice;
    voice.string = allocate_string_state(sizes);
    voice.touches = make_touch_state(sizes.stride);
    voice.bend = make_bend_state(sizes);
    return voice;
}

void reset_voice(Voice& voice) JAWARI_REALTIME {
    voice.phase = VoicePhase::Idle;
    voice.fret = 0;
    voice.channel = 0;
    voice.string.counters = {};
    lift_all_touches(voice.touches);
    voice.touches.noises = 0;
    forget_bend(voice);
    voice.bend.target = 0;
    voice.slide = {};
    voice.age = 0;
    voice.fading = false;
    voice.rests_on_obstacles = false;
    voice.fade_frame = 0;
    voice.rise_frame = 0;
    voice.remainder = {};
    voice.end = {};
    begin_anew(voice.run);
    voice.gains = {};
    voice.targets = {};
}

void start_voice(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                 std::size_t fret, int channel, double action_m) JAWARI_REALTIME {
    const StoppedStringModel& stopped = string.stopped[fret];
    voice.phase = VoicePhase::Sounding;
    voice.fret = fret;
    voice.channel = channel;
    voice.age = 0;
    voice.fading = false;
    voice.fade_frame = 0;
    voice.rise_frame = model.fade_shape.size();
    voice.remainder = {};
    voice.end = {};
    begin_anew(voice.run);
    voice.slide.active = false;
    voice.rests_on_obstacles = stopped.held_energy_J != 0;
    forget_bend(voice);
    reset(stopped.string, voice.string);
    lower_obstacles(stopped, voice.string, action_m);
    lift_all_touches(voice.touches);
    lay_soft_touches(string, voice);
}

void strike_voice(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                  const Stroke& stroke, double position_factor) JAWARI_REALTIME {
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    const StringPlace& place = string.exciter_places[stroke.exciter];
    const bool placed = place.share > 0 || place.from_bridge_m > 0;
    const double x = placed ? place_on(stopped, place, position_factor) : 0.0;
    const double described_x = placed ? place_on(stopped, place, 1) : 0.0;
    const Strike strike{model, string, voice, stroke, x, described_x};
    // Not std::visit: it may throw.
    const auto& body = model.exciters[stroke.exciter].body;
    if (const auto* finger = std::get_if<FingerDescription>(&body)) strike_with(*finger, strike);
    if (const auto* hammer = std::get_if<HammerDescription>(&body)) strike_with(*hammer, strike);
    if (const auto* tangent = std::get_if<TangentDescription>(&body)) strike_with(*tangent, strike);
    voice.touches.outdated = true;
}

void fade_voice(Voice& voice) JAWARI_REALTIME {
    if (voice.fading) return;
    voice.fading = true;
    voice.fade_frame = 0;
    if (voice.rests_on_obstacles) return;
    // Nobody hears what hands and obstacles would do to it in these milliseconds.
    lift_all_touches(voice.touches);
    leave_obstacles(voice.string);
}

void advance_voice(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                   double smoothing, InstrumentState& state, std::span<VoiceSignals> sums) JAWARI_REALTIME {
    JAWARI_ASSERT(sums.size() <= longest_voice_run);
    const StringModel& coefficients = voice_model(string, voice);
    OutputReadings readings;  // NOLINT(cppcoreguidelines-pro-type-member-init): set as far as it is read
    set_output_readings(model, string.stopped[voice.fret], readings);
    VoiceRun run{model, string, voice, smoothing, state, readings, state.frame};
    TouchedRun touched;  // NOLINT(cppcoreguidelines-pro-type-member-init): likewise
    const bool flies = only_flies(coefficients, run);
    if (flies) touched.read_row = readings.rows[0].row;
    for (std::size_t n = 0; n < sums.size() && voice.phase != VoicePhase::Idle;) {
        const std::uint64_t resets = voice.string.counters.nonfinite_resets;
        std::size_t passed = 1;
        if (is_untouched(voice.touches)) {
            passed = pass_untouched(coefficients, run, n, sums.size() - n);
            touched.known.count = 0;
        } else if (flies) {
            touched.goes_on = n + 1 < sums.size();
            fly_touched_frame(coefficients, run, touched, n);
        } else {
            pass_touched(coefficients, run, n);
        }
        for (const std::size_t end = n + passed; n < end && voice.phase != VoicePhase::Idle; ++n)
            add_signals(run, n, resets, sums[n]);
    }
}

double voice_energy(const InstrumentStringModel& string, Voice& voice) JAWARI_REALTIME {
    const StringModel& model = voice_model(string, voice);
    if (string.stopped[voice.fret].held_energy_J == 0) return energy(model, voice.string);
    AlignedVector<double>& beyond = voice.touches.moved;
    for (std::size_t k = 0; k < model.shape->stride; ++k)
        beyond[k] = voice.string.displacement[k] - model.shape->rest_displacement[k];
    return kernels::energy(model.shape->stride, model.tuning.kinetic.data(), model.tuning.potential.data(),
                           model.shape->step_s / 2, beyond.data(), voice.string.velocity.data());
}

}  // namespace jawari
