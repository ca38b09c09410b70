#include "instrument/voice/hands.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "instrument/model/played_string.h"
#include "instrument/model/stops.h"
#include "instrument/touch/exciters.h"
#include "instrument/touch/touches.h"

namespace jawari {
namespace {

/// Where the stopping hand lies for a dead note: share of the speaking length from its start.
constexpr double dead_share = 0.21;
/// In which hands come down on a ringing string and leave it; a stopping hand is quicker.
constexpr double hand_ease_s = 0.01;
constexpr double left_ease_s = 0.003;
/// How far the damping hand sweeps to either side: share of the speaking length.
constexpr double hand_sweep = 0.08;
/// Of the damping that absorbs best: near it, twice the damping changes nothing.
constexpr double firmest_palm = 0.5;
/// Hands and exciters keep this share of the speaking length from its ends, where no force moves the string.
constexpr double end_share = 0.01;

}  // namespace

double damping_for(const StoppedStringModel& stopped, double x, double t60_s) JAWARI_REALTIME {
    const StringModel& model = stopped.string;
    const double sine = std::sin(std::numbers::pi * x / model.shape->length_m);
    const double shape2 = 2 / model.shape->length_m * sine * sine;
    const double wanted = 2 * model.shape->linear_density_kg_per_m * std::log(1000.0) / (t60_s * shape2);
    return std::min(wanted, stopped.wave_impedance_kg_per_s * std::max(2.0, 1 / sine));
}

double place_on(const StoppedStringModel& stopped, const StringPlace& place, double factor) JAWARI_REALTIME {
    const double length_m = stopped.string.shape->length_m;
    const double distance =
        std::clamp(factor * from_bridge(place, length_m), end_share * length_m, (1 - end_share) * length_m);
    return length_m - distance;
}

void lay_damping_hand(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                      double release_velocity, double time_factor) JAWARI_REALTIME {
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    const double spread = std::pow(model.hand.release_spread, 1 - 2 * release_velocity);
    const double t60_s = string.release_t60_s * time_factor * spread;
    for (std::size_t i = 0; i < 2; ++i) {
        const double x = place_on(stopped, model.hand.release_places[i], 1);
        const TouchSlot slot = i == 0 ? TouchSlot::Release : TouchSlot::ReleaseSecond;
        lay_touch(voice_model(string, voice), voice.string, voice.touches, slot,
                  {.x_m = x,
                   .sweep_m = hand_sweep * stopped.string.shape->length_m,
                   .damping_kg_per_s = damping_for(stopped, x, 2 * t60_s),
                   .ease_frames = hand_ease_s * model.output_rate_hz,
                   .noise_N = i == 0 ? model.hand.release_noise_N / spread : 0.0,
                   .noise_frames = frames_of(model.hand.release_noise_s, model.output_rate_hz)});
    }
}

void lift_damping_hand(Voice& voice) JAWARI_REALTIME {
    lift_touch(voice.touches, TouchSlot::Release);
    lift_touch(voice.touches, TouchSlot::ReleaseSecond);
}

void press_palm(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice, double mute,
                double position_factor) JAWARI_REALTIME {
    const Touch& palm = touch_at(voice.touches, TouchSlot::Palm);
    if (!(mute > 0)) {
        lift_touch(voice.touches, TouchSlot::Palm);
        return;
    }
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    const double x = place_on(stopped, model.hand.palm_place, position_factor);
    // The decay changes evenly with the parameter if the damping follows its square; near the bridge even a
    // weak palm asks for more than absorbs best.
    const double damping =
        firmest_palm * mute * mute * damping_for(stopped, x, model.hand.palm_t60_s * firmest_palm);
    if (palm.active) {
        press_touch(voice.touches, TouchSlot::Palm, damping);
    } else {
        lay_touch(voice_model(string, voice), voice.string, voice.touches, TouchSlot::Palm,
                  {.x_m = x, .damping_kg_per_s = damping, .ease_frames = hand_ease_s * model.output_rate_hz});
    }
}

void deaden(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
            double firmness) JAWARI_REALTIME {
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    const double x = dead_share * stopped.string.shape->length_m;
    lay_touch(voice_model(string, voice), voice.string, voice.touches, TouchSlot::Left,
              {.x_m = x,
               .damping_kg_per_s = damping_for(stopped, x, model.hand.dead_t60_s / firmness),
               .ease_frames = left_ease_s * model.output_rate_hz});
}

void touch_node(const InstrumentModel& model, const InstrumentStringModel& string, Voice& voice,
                int number) JAWARI_REALTIME {
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    const double x = stopped.string.shape->length_m / number;
    lay_touch(voice_model(string, voice), voice.string, voice.touches, TouchSlot::Left,
              {.x_m = x,
               .damping_kg_per_s = damping_for(stopped, x, model.hand.harmonic_t60_s),
               .frames = frames_of(model.hand.harmonic_touch_s, model.output_rate_hz),
               .ease_frames = left_ease_s * model.output_rate_hz});
}

void lay_soft_touches(const InstrumentStringModel& string, Voice& voice) JAWARI_REALTIME {
    const StoppedStringModel& stopped = string.stopped[voice.fret];
    for (std::size_t i = 0; i < string.soft_touches.size(); ++i) {
        const SoftTouchDescription& soft = string.soft_touches[i];
        const TouchSlot slot = i == 0 ? TouchSlot::SoftFirst : TouchSlot::SoftSecond;
        lay_touch(voice_model(string, voice), voice.string, voice.touches, slot,
                  {.x_m = place_on(stopped, soft.place, 1),
                   .width_m = soft.width_m,
                   .damping_kg_per_s = soft.damping_kg_per_s,
                   .stiffness_N_per_m = soft.stiffness_N_per_m});
    }
}

}  // namespace jawari
