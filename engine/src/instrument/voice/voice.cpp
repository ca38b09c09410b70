#include "instrument/voice/voice.h"

#include <algorithm>
#include <cmath>

#include "instrument/touch/exciters.h"
#include "instrument/touch/touches.h"
#include "instrument/voice/bend.h"
#include "instrument/voice/hands.h"
#include "instrument/voice/pickups.h"
#include "jawari/scene/energy.h"
#include "jawari/scene/render.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

/// Output frames between two looks at a voice's energy.
constexpr std::uint64_t rest_check_frames = 64;
/// A finger that comes down on a ringing string has at least this share of its wave impedance.
constexpr double finger_share = 0.5;
/// A finger's damping comes and leaves in this part of the rise each.
constexpr std::uint64_t damping_eases = 4;

void finish(Voice& voice, InstrumentState& state) {
    state.finished += voice.string.counters;
    voice.string.counters = {};
    voice.phase = VoicePhase::Idle;
    voice.fading = false;
    voice.slide.active = false;
    lift_all_touches(voice.touches);
    forget_bend(voice);
}

/// Gain of fading in and out.
double fade_gain(const InstrumentModel& model, Voice& voice) {
    double gain = 1;
    if (voice.rise_frame < model.fade_shape.size()) {
        gain -= model.fade_shape[voice.rise_frame];
        voice.rise_frame += 1;
    }
    if (!voice.fading) return gain;
    gain *= model.fade_shape[voice.fade_frame];
    voice.fade_frame += 1;
    return gain;
}

bool has_ended(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice) {
    if (voice.fading) return voice.fade_frame >= model.fade_shape.size();
    if (voice.age % rest_check_frames != 0 || voice.touches.exciter.phase != ExciterPhase::None) return false;
    return voice_energy(string, voice) < string.stopped[voice.fret].rest_energy_J;
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

VoiceSignals advance_voice(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                           double smoothing, InstrumentState& state) JAWARI_REALTIME {
    const StringModel& coefficients = voice_model(string, voice);
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    apply_touches(coefficients, voice.string, voice.touches);
    const std::uint64_t impulses = voice.string.counters.impulses;
    const std::uint64_t resets = voice.string.counters.nonfinite_resets;
    advance_frame(coefficients, voice.string);
    const bool struck = voice.string.counters.impulses != impulses;
    meter_touches(coefficients, voice.string, voice.touches, struck, state.work);
    voice.age += 1;
    follow_gains(voice, smoothing);
    const double gain = voice.gains.level * fade_gain(model, voice);
    VoiceSignals signals;
    signals.pickups = gain * pickup_signal(model, stopped, voice.string, voice.gains.mix);
    signals.left = voice.gains.left * signals.pickups;
    signals.right = voice.gains.right * signals.pickups;
    if (model.body.count > 0)
        signals.bridge_N = gain * voice.gains.body * bridge_force(stopped, voice.string);
    const bool finite = std::isfinite(signals.left + signals.right + signals.bridge_N);
    if (!finite || voice.string.counters.nonfinite_resets != resets) {
        // The string is at rest, but what has lost it may be a hand, a hammer or a gain: the voice ends, and
        // the next note starts with nothing of it.
        voice.string.counters.nonfinite_resets = resets + 1;
        finish(voice, state);
        return {};
    }
    if (has_ended(model, string, voice)) finish(voice, state);
    return signals;
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
