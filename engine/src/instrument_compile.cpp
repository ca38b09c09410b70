// Strings stopped at frets: geometry, tension, losses of the damping hand, finger force and pickups.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "excitation.h"
#include "instrument_geometry.h"
#include "instrument_validate.h"
#include "jawari/compile.h"
#include "jawari/energy.h"
#include "jawari/instrument_model.h"
#include "jawari/modes.h"
#include "jawari/obstacles.h"
#include "jawari/render.h"
#include "jawari/state.h"
#include "jawari/step_coefficients.h"

namespace jawari {
namespace {

constexpr double pi = std::numbers::pi;

/// Partials between this share of the output's Nyquist rate and all of it leave the output by half a cosine:
/// what an impulse sends to a pickup arrives as a band-limited pulse, without a step that would alias.
constexpr double taper_start = 0.85;

double square(double x) {
    return x * x;
}

double half_cosine(double x) {
    return 0.5 * (1 - std::cos(pi * x));
}

/// The damping hand adds the same loss to every mode.
ModeTable with_damping_hand(const StringModel& ringing, double t60_s) {
    ModeTable table;
    for (std::size_t k = 0; k < ringing.mode_count; ++k) {
        table.frequency_hz.push_back(ringing.omega[k] / (2 * pi));
        table.decay_per_s.push_back(ringing.sigma[k] + std::log(1000.0) / t60_s);
    }
    return table;
}

/// Both backward velocities are linear in (q, true velocity u): v = a q + c u. Eliminating u:
/// v_damped = (c_d/c_r) v + (a_d - a_r c_d/c_r) q.
void set_damping_change(StoppedStringModel& stopped) {
    const StringModel& ringing = stopped.ringing;
    const double h = ringing.step_s;
    stopped.velocity_share.assign(ringing.stride, 0.0);
    stopped.displacement_share.assign(ringing.stride, 0.0);
    for (std::size_t k = 0; k < ringing.mode_count; ++k) {
        const auto backward = [&](const StringModel& model, double q, double u) {
            return exact_backward_velocity(model.omega[k], model.sigma[k], h, q, u);
        };
        const double share = backward(stopped.damped, 0, 1) / backward(ringing, 0, 1);
        stopped.velocity_share[k] = share;
        stopped.displacement_share[k] = backward(stopped.damped, 1, 0) - share * backward(ringing, 1, 0);
    }
}

/// Mean of phi_k over the pickup's width: phi_k(x) sin(z)/z, z = k pi width / 2L.
double sensed(std::size_t k, const PickupDescription& pickup, double length_m) {
    const double z = static_cast<double>(k) * pi * pickup.width_m / (2 * length_m);
    const double average = z > 0 ? std::sin(z) / z : 1.0;
    return pickup.level * average * mode_shape(k, length_m - pickup.place.from_bridge_m, length_m);
}

double audible_share(double frequency_hz, double output_rate_hz) {
    const double edge = frequency_hz / (output_rate_hz / 2);
    if (edge >= 1) return 0;
    return edge <= taper_start ? 1.0 : half_cosine((1 - edge) / (1 - taper_start));
}

void set_rows(StoppedStringModel& stopped, const InstrumentDescription& instrument, double string_level,
              double output_rate_hz) {
    const StringModel& model = stopped.ringing;
    stopped.pluck_row.assign(model.stride, 0.0);
    stopped.output_row.assign(model.stride, 0.0);
    const double pluck_x = model.length_m - instrument.exciters[0].place.from_bridge_m;
    for (std::size_t k = 1; k <= model.mode_count; ++k) {
        stopped.pluck_row[k - 1] = mode_shape(k, pluck_x, model.length_m);
        double row = 0;
        for (const PickupDescription& pickup : instrument.pickups) row += sensed(k, pickup, model.length_m);
        const double share = audible_share(model.omega[k - 1] / (2 * pi), output_rate_hz);
        stopped.output_row[k - 1] = instrument.gain * string_level * share * row;
    }
}

/// Plays the pluck's force at a size that reaches no fret, so that the string answers linearly, and scales
/// the answer.
void calibrate_finger(StoppedStringModel& stopped, const InstrumentModel& instrument, double full_height_m) {
    constexpr double trial_force_N = 1e-6;
    const StringModel& model = stopped.ringing;
    StringState state = make_string_state(model);
    const std::vector<double>& shape = instrument.pluck_shape;
    double height_m = 0;
    double energy_J = 0;
    for (std::size_t i = 0; i + 1 < shape.size(); ++i) {
        clear_excitation(model, state);
        add_force(
            model, state, stopped.pluck_row.data(), trial_force_N * shape[i],
            trial_force_N * (shape[i + 1] - shape[i]) / static_cast<double>(instrument.steps_per_frame));
        advance_frame(model, state);
        double lift_m = 0;
        for (std::size_t k = 0; k < model.stride; ++k) lift_m += stopped.pluck_row[k] * state.displacement[k];
        height_m = std::max(height_m, lift_m);
        energy_J = energy(model, state);
    }
    stopped.full_force_N = trial_force_N * full_height_m / height_m;
    stopped.rest_energy_J = rest_energy_ratio * energy_J * square(stopped.full_force_N / trial_force_N);
}

/// Half-cosine flanks at the frames' boundaries: 0 at the first, 1 after the rise, 0 at the last.
std::vector<double> pluck_shape(const FingerDescription& pluck, double output_rate_hz) {
    const auto frames = [&](double seconds) {
        return static_cast<std::size_t>(std::ceil(seconds * output_rate_hz));
    };
    const std::size_t rise = std::max<std::size_t>(frames(pluck.rise_s), 1);
    const std::size_t release = std::max<std::size_t>(frames(pluck.release_s), 1);
    std::vector<double> shape;
    for (std::size_t i = 0; i <= rise; ++i) shape.push_back(half_cosine(double(i) / double(rise)));
    for (std::size_t i = 1; i <= release; ++i)
        shape.push_back(half_cosine(double(release - i) / double(release)));
    return shape;
}

std::vector<double> fade_shape(double output_rate_hz) {
    const auto frames = static_cast<std::size_t>(std::ceil(fade_s * output_rate_hz));
    std::vector<double> shape;
    for (std::size_t i = 1; i <= frames; ++i)
        shape.push_back(half_cosine(double(frames - i) / double(frames)));
    return shape;
}

Result<StringModel> compile_string(const StringDescription& string, const InstrumentDescription& instrument,
                                   const InstrumentModel& model, const std::string& place) {
    SceneDescription scene;
    scene.output_rate_hz = model.output_rate_hz;
    scene.contact_rate_hz = model.contact_rate_hz;
    scene.law = instrument.law;
    scene.strings.push_back(string);
    auto compiled = compile(scene);
    if (compiled.ok()) return std::move(compiled.value().strings[0]);
    Failure failure = compiled.failure();
    const std::string in_scene = "strings[0].";
    const bool own = failure.place.rfind(in_scene, 0) == 0;
    failure.place = place + (own ? failure.place.substr(in_scene.size()) : failure.place);
    return failure;
}

Result<StoppedStringModel> compile_stopped(const InstrumentDescription& instrument,
                                           const InstrumentModel& model, std::size_t index,
                                           std::size_t fret) {
    const InstrumentStringDescription& string = instrument.strings[index];
    std::string place = "strings[" + std::to_string(index) + "]";
    StringDescription description = stopped_string(instrument, index, fret);
    const std::size_t modes = std::get<PhysicalModes>(description.modes).count;
    if (modes > limits::instrument_modes) {
        return Failure{"mode_limit_hz", std::to_string(modes) + " modes or more on " + place,
                       "at most " + std::to_string(limits::instrument_modes) + " modes on a string"};
    }
    place += fret == 0 ? "." : " at fret " + std::to_string(fret) + ".";
    StoppedStringModel stopped;
    auto ringing = compile_string(description, instrument, model, place);
    if (!ringing) return ringing.failure();
    stopped.ringing = std::move(ringing.value());
    description.modes = with_damping_hand(stopped.ringing, instrument.hand.release_t60_s);
    auto damped = compile_string(description, instrument, model, place);
    if (!damped) return damped.failure();
    stopped.damped = std::move(damped.value());
    set_damping_change(stopped);
    set_rows(stopped, instrument, string.level, model.output_rate_hz);
    calibrate_finger(stopped, model, std::get<FingerDescription>(instrument.exciters[0].body).full_height_m);
    return stopped;
}

}  // namespace

Result<InstrumentModel> compile_instrument(const InstrumentDescription& instrument, double output_rate_hz) {
    if (auto failure = validate(instrument, output_rate_hz)) return *std::move(failure);
    InstrumentModel model;
    model.name = instrument.name;
    model.output_rate_hz = output_rate_hz;
    model.steps_per_frame =
        static_cast<std::size_t>(std::ceil(instrument.quality.contact_rate_min_hz / output_rate_hz));
    model.contact_rate_hz = output_rate_hz * static_cast<double>(model.steps_per_frame);
    model.height_exponent = std::get<FingerDescription>(instrument.exciters[0].body).height_exponent;
    model.pluck_shape = pluck_shape(std::get<FingerDescription>(instrument.exciters[0].body), output_rate_hz);
    model.fade_shape = fade_shape(output_rate_hz);
    for (std::size_t s = 0; s < instrument.strings.size(); ++s) {
        InstrumentStringModel& string = model.strings.emplace_back();
        string.name = instrument.strings[s].name;
        string.open_note = instrument.strings[s].open_note;
        for (std::size_t fret = 0; fret <= instrument.frets.count; ++fret) {
            auto stopped = compile_stopped(instrument, model, s, fret);
            if (!stopped) return stopped.failure();
            string.stopped.push_back(std::move(stopped.value()));
        }
    }
    return model;
}

}  // namespace jawari
