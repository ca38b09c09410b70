// description -> const instrument model: strings at their stops, courses, and what exciters need to know.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "base/square.h"
#include "instrument/compile/validate.h"
#include "instrument/model/stops.h"
#include "instrument/touch/exciters.h"
#include "instrument/touch/touches.h"
#include "instrument/voice/bend.h"
#include "instrument/voice/body.h"
#include "instrument/voice/bridge_model.h"
#include "instrument/voice/pickups.h"
#include "jawari/instrument/compile.h"
#include "jawari/instrument/model.h"
#include "jawari/scene/compile.h"
#include "jawari/scene/energy.h"
#include "string/kernels/flight.h"
#include "string/kernels/mode_bounds.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

// ---------------------------------------------------------------------------------------------- one stop

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

/// Motion without contacts under forces held over frames, started at rest: what a calibration plays.
struct FreeString {
    const StringModel& model;
    AlignedVector<double> q, v, q_next, v_next;

    explicit FreeString(const StringModel& string)
        : model(string), q(string.shape->stride, 0.0), v(q), q_next(q), v_next(q) {}

    void advance(const AlignedVector<double>& held) {
        kernels::fly(model.shape->stride, model.tuning.flight, q.data(), v.data(), q_next.data(),
                     v_next.data());
        kernels::add_force_response(model.shape->stride, model.tuning.flight, held.data(), nullptr, 0,
                                    q_next.data(), v_next.data());
        q.swap(q_next);
        v.swap(v_next);
    }
    [[nodiscard]] double energy() const {
        return kernels::energy(model.shape->stride, model.tuning.kinetic.data(),
                               model.tuning.potential.data(), model.shape->step_s / 2, q.data(), v.data());
    }
};

/// Force at velocity 1, and the energy that the string has then.
struct Calibration {
    double force_N = 0;
    double energy_J = 0;
};

/// Plays the finger's force at 1 N: the string without contacts answers linearly, so the answer scales.
Calibration calibrate_finger(const StoppedStringModel& stopped, const FingerDescription& finger, double x,
                             double width_m, double rate_hz, double excitation) {
    FreeString string(stopped.string);
    AlignedVector<double> row(stopped.string.shape->stride), held(stopped.string.shape->stride);
    write_point_row(stopped.string, stopped.string.shape->stride, x, width_m, row.data());
    const std::uint64_t rise = frames_of(finger.rise_s, rate_hz);
    const std::uint64_t release = frames_of(finger.release_s, rate_hz);
    double height_m = 0;
    for (std::uint64_t n = 0; n < rise + release; ++n) {
        const double force = finger_shape(n, rise, release);
        for (std::size_t k = 0; k < row.size(); ++k) held[k] = force * row[k];
        string.advance(held);
        double lift_m = 0;
        for (std::size_t k = 0; k < row.size(); ++k) lift_m += row[k] * string.q[k];
        height_m = std::max(height_m, lift_m);
    }
    Calibration calibration;
    calibration.force_N = excitation * finger.full_height_m / height_m;
    calibration.energy_J = square(calibration.force_N) * string.energy();
    return calibration;
}

/// The end moves by b: of the order of mu b'^2 L/2 goes into the string.
double tangent_energy(const StoppedStringModel& stopped, const TangentDescription& tangent) {
    const double speed = tangent.full_height_m / tangent.rise_s;
    return stopped.string.shape->linear_density_kg_per_m * stopped.string.shape->length_m * square(speed) / 2;
}

void calibrate_exciters(StoppedStringModel& stopped, const InstrumentModel& model,
                        const InstrumentStringModel& string) {
    const double length_m = stopped.string.shape->length_m;
    double largest_J = 0;
    for (std::size_t i = 0; i < model.exciters.size(); ++i) {
        const ExciterDescription& exciter = model.exciters[i];
        Calibration calibration;
        if (const auto* finger = std::get_if<FingerDescription>(&exciter.body)) {
            const double x = length_m - from_bridge(string.exciter_places[i], length_m);
            calibration = calibrate_finger(stopped, *finger, x, exciter.width_m, model.output_rate_hz,
                                           string.excitation);
        } else if (const auto* hammer = std::get_if<HammerDescription>(&exciter.body)) {
            calibration.energy_J =
                hammer->mass_kg * square(string.excitation * hammer->full_speed_m_per_s) / 2;
        } else {
            calibration.energy_J = square(string.excitation) *
                                   tangent_energy(stopped, std::get<TangentDescription>(exciter.body));
        }
        stopped.full_force_N.push_back(calibration.force_N);
        largest_J = std::max(largest_J, calibration.energy_J);
    }
    stopped.rest_energy_J = rest_energy_ratio * largest_J;
    const StringModel& compiled = stopped.string;
    const AlignedVector<double> still(compiled.shape->stride, 0.0);
    stopped.held_energy_J = kernels::energy(compiled.shape->stride, compiled.tuning.kinetic.data(),
                                            compiled.tuning.potential.data(), compiled.shape->step_s / 2,
                                            compiled.shape->rest_displacement.data(), still.data());
}

void find_action_contacts(StoppedStringModel& stopped, const InstrumentDescription& instrument,
                          std::size_t index, std::size_t fret) {
    const std::vector<bool> on_neck = contacts_on_neck(instrument, index, fret);
    for (std::size_t c = 0; c < on_neck.size(); ++c) {
        const std::ptrdiff_t kept = stopped.string.shape->contact_of_description[c];
        if (on_neck[c] && kept >= 0) stopped.action_contacts.push_back(static_cast<std::uint32_t>(kept));
    }
}

Result<StoppedStringModel> compile_stopped(const InstrumentDescription& instrument,
                                           const InstrumentModel& model, std::size_t index,
                                           std::size_t fret) {
    StoppedStringModel stopped;
    stopped.frequency_hz = note_frequency(instrument, instrument.strings[index], fret);
    if (!std::isfinite(stopped.frequency_hz)) {  // no key plays it
        stopped.string.shape = std::make_shared<const StringShape>();
        return stopped;
    }
    const FretsDescription& frets = frets_of(instrument, instrument.strings[index]);
    if (!instrument.strings[index].sympathetic)
        stopped.key = instrument.strings[index].open_note + semitones_of(frets, fret);
    std::string place = detail::indexed_place("strings", index);
    const StringDescription description = stopped_string(instrument, index, fret);
    const auto& modes = std::get<PhysicalModes>(description.modes);
    if (modes.count > limits::instrument_modes) {
        return Failure{"mode_limit_hz", std::to_string(modes.count) + " modes or more on " + place,
                       "at most " + std::to_string(limits::instrument_modes) + " modes on a string"};
    }
    place += fret == 0 ? "." : " at fret " + std::to_string(fret) + ".";
    auto compiled = compile_string(description, instrument, model, place);
    if (!compiled) return compiled.failure();
    stopped.string = std::move(compiled.value());
    stopped.inharmonicity = modes.inharmonicity;
    stopped.wave_impedance_kg_per_s = std::sqrt(modes.tension_N * description.linear_density_kg_per_m);
    set_retuning_tables(stopped);
    set_output_rows(stopped, instrument, model.output_rate_hz);
    if (instrument.bridge) set_end_bounds(stopped);
    if (instrument.bridge)
        stopped.bridge_stiffness_N_per_m =
            end_stiffness(stopped.string, stopped.end_row.data(), modes.tension_N, 1);
    calibrate_exciters(stopped, model, model.strings[index]);
    find_action_contacts(stopped, instrument, index, fret);
    return stopped;
}

// ---------------------------------------------------------------------------------------------- strings

InstrumentStringModel string_without_stops(const InstrumentDescription& instrument, std::size_t index) {
    const InstrumentStringDescription& described = instrument.strings[index];
    InstrumentStringModel string;
    string.name = described.name;
    string.level = instrument.gain * described.level;
    string.own_level = described.level;
    string.sympathetic = described.sympathetic;
    string.pan = described.pan;
    string.excitation = described.excitation;
    string.release_t60_s =
        described.release_t60_s > 0 ? described.release_t60_s : instrument.hand.release_t60_s;
    for (const ExciterDescription& exciter : instrument.exciters)
        string.exciter_places.push_back(described.exciter_place.value_or(exciter.place));
    for (const SoftTouchDescription& touch : instrument.soft_touches) {
        if (applies_to(touch.strings, index)) string.soft_touches.push_back(touch);
    }
    return string;
}

/// In the order of their first strings.
void set_courses(InstrumentModel& model, const InstrumentDescription& instrument) {
    std::vector<std::optional<std::size_t>> numbers;
    for (std::size_t s = 0; s < instrument.strings.size(); ++s) {
        const std::optional<std::size_t>& number = instrument.strings[s].course;
        const auto known = number ? std::find(numbers.begin(), numbers.end(), number) : numbers.end();
        const auto course = static_cast<std::size_t>(known - numbers.begin());
        if (known == numbers.end()) {
            numbers.push_back(number);
            model.courses.emplace_back();
        }
        model.courses[course].strings.push_back(s);
        model.strings[s].course = course;
    }
}

std::optional<Failure> compile_stops(InstrumentModel& model, const InstrumentDescription& instrument,
                                     std::size_t index) {
    InstrumentStringModel& string = model.strings[index];
    const InstrumentStringDescription& described = instrument.strings[index];
    const std::size_t frets = described.sympathetic ? 0 : frets_of(instrument, described).count;
    for (std::size_t fret = 0; fret <= frets; ++fret) {
        auto stopped = compile_stopped(instrument, model, index, fret);
        if (!stopped) return stopped.failure();
        string.sizes = larger(string.sizes, sizes_of(stopped.value().string));
        string.stopped.push_back(std::move(stopped.value()));
    }
    return {};
}

/// The least energy that a string of the instrument answers with, as one that the body has.
double least_drive(const InstrumentModel& model) {
    double least_J = std::numeric_limits<double>::infinity();
    for (const InstrumentStringModel& string : model.strings) {
        const double rest_J = string.stopped[0].rest_energy_J;
        if (rest_J > 0) least_J = std::min(least_J, rest_J);
    }
    return answer_energy_ratio * least_J;
}

std::vector<double> fade_shape(double output_rate_hz) {
    const std::uint64_t frames = frames_of(fade_s, output_rate_hz);
    std::vector<double> shape;
    for (std::uint64_t i = 1; i <= frames; ++i)
        shape.push_back(
            0.5 + 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(frames)));
    return shape;
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
    model.play = instrument.play;
    model.exciters = instrument.exciters;
    model.hand = instrument.hand;
    model.pickups = instrument.pickups;
    model.fade_shape = fade_shape(output_rate_hz);
    model.body = body_model(instrument, output_rate_hz);
    model.bridge = bridge_model(instrument, output_rate_hz);
    for (std::size_t s = 0; s < instrument.strings.size(); ++s)
        model.strings.push_back(string_without_stops(instrument, s));
    set_courses(model, instrument);
    for (std::size_t s = 0; s < instrument.strings.size(); ++s) {
        if (auto failure = compile_stops(model, instrument, s)) return *std::move(failure);
    }
    model.bridge.least_drive_J = least_drive(model);
    return model;
}

}  // namespace jawari
