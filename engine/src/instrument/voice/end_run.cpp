#include "instrument/voice/end_run.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "instrument/touch/touches.h"
#include "instrument/voice/pickups.h"
#include "string/frame/forced_flight.h"
#include "string/kernels/end_flight.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

/// Where a flight has been refused it is tried again after so many frames.
constexpr std::uint64_t frames_until_next_try = 8;
/// The end is expected to travel by so much of what it did in runs before, which fades by this factor.
constexpr double spare_travel = 2;
constexpr double swing_kept = 0.8;

/// Reading t of the run, or what it answers.
double* reading_of(AlignedVector<double>& values, std::size_t t) {
    return values.data() + t * end_run_stride;
}

/// Reads what the rows see of a motion from (q, v) on, in the order of EndRun::readings.
void read_flight(const EndFlyer& flyer, const EndRun& run, std::size_t frames, const double* q,
                 const double* v, AlignedVector<double>& out) {
    OutputReadings outputs;  // NOLINT(cppcoreguidelines-pro-type-member-init): set as far as it is read
    set_output_readings(flyer.model, flyer.stopped, outputs);
    kernels::EndReading reading;  // NOLINT(cppcoreguidelines-pro-type-member-init): likewise
    reading.modes = run.modes;
    reading.frames = frames;
    reading.flight = &flyer.string.tuning.flight;
    reading.coefficients = &run.coefficients;
    reading.q = q;
    reading.v = v;
    reading.of_v = -flyer.string.shape->step_s / 2;
    reading.rows = 1;
    reading.row[0] = flyer.end.row;
    reading.out[0] = reading_of(out, 0);
    std::size_t pickups = outputs.count;
    if (flyer.model.body.count > 0) {
        reading.rows = 2;
        reading.row[1] = flyer.stopped.bridge_row.data();
        reading.out[1] = reading_of(out, outputs.count);
        --pickups;
    }
    kernels::read_end_run(reading);
    reading.rows = 1;
    for (std::size_t i = 0; i < pickups; ++i) {
        reading.row[0] = outputs.rows[i].row;
        reading.out[0] = reading_of(out, i + 1);
        reading.of_q = outputs.rows[i].of_velocity ? 0.0 : 1.0;
        reading.of_v = outputs.rows[i].of_velocity ? 1.0 : 0.0;
        kernels::read_end_run(reading);
    }
    JAWARI_ASSERT(run.count == outputs.count + 1);
}

/// Modes that the end moves: those beyond are above what is heard.
std::size_t reach_of(const StringModel& string, const double* row) {
    std::size_t reach = string.shape->mode_count;
    while (reach > 0 && row[reach - 1] == 0) --reach;
    return std::min(padded(reach), string.shape->stride);
}

/// Displacements at rest with the end at 1 m, row_k/(2 potential_k), and how far they, and free motion from
/// there, bend the string at its contacts.
void set_rest(const StringModel& string, const double* row, StringState& state, EndRun& run) {
    AlignedVector<double>& at_rest = run.coefficients.still;
    for (std::size_t k = 0; k < string.shape->stride; ++k)
        at_rest[k] = row[k] == 0 ? 0.0 : row[k] / (2 * string.tuning.potential[k]);
    run.bend = run.sway = 0;
    const CertificateTuning& bounds = string.tuning.certificate;
    const std::size_t contacts = string.shape->contact_count;
    if (contacts == 0 || bounds.extent.empty()) return;
    double sum = 0;
    for (std::size_t k = 0; k < string.shape->mode_count; ++k)
        sum += bounds.extent[k] * std::sqrt(bounds.stiffness[k]) * std::abs(at_rest[k]);
    run.sway = bound_safety * std::sqrt(2 / string.shape->length_m) * sum;
    std::vector<double>& bends = state.certificate.bounds.frame_end_gap;
    kernels::row_products(contacts, string.shape->stride, string.shape->stride,
                          string.shape->contact_rows.data(), at_rest.data(), bends.data());
    for (std::size_t c = 0; c < contacts; ++c) run.bend = std::max(run.bend, std::abs(bends[c]));
    run.bend *= bound_safety;
}

ForceShape shape_of(const EndRun& run) {
    return {
        .modes = run.reach, .still = run.coefficients.still.data(), .bend_m = run.bend, .sway_m = run.sway};
}

void prepare(const EndFlyer& flyer, Voice& voice) {
    EndRun& run = voice.run;
    run.outdated = false;
    set_rest(flyer.string, flyer.end.row, voice.string, run);
    run.reach = reach_of(flyer.string, flyer.end.row);
    run.modes = run.reach;
    kernels::set_end_coefficients(flyer.string.shape->stride, flyer.string.tuning.flight, flyer.end.row,
                                  run.coefficients);
    read_flight(flyer, run, longest_end_run, run.coefficients.q_last.data(), run.coefficients.v_last.data(),
                run.responses);
}

bool is_finite(EndRun& run) {
    double sum = 0;
    for (std::size_t t = 0; t < run.count; ++t) {
        const double* reading = reading_of(run.readings, t);
        for (std::size_t n = 0; n <= run.frames; ++n) sum += reading[n];
    }
    return std::isfinite(sum);
}

void swap_flown(StringState& string) {
    string.displacement.swap(string.displacement_flown);
    string.velocity.swap(string.velocity_flown);
}

/// displacement and velocity <- those of now, and those of the start lie in the arrays of flown ones. Returns
/// whether they are finite.
bool move_on(const StringModel& model, Voice& voice) {
    EndRun& run = voice.run;
    StringState& string = voice.string;
    const bool finite =
        kernels::end_short_run(run.modes, run.passed, model.tuning.flight, run.coefficients,
                               run.zeta_m.data(), string.displacement.data(), string.velocity.data(),
                               string.displacement_flown.data(), string.velocity_flown.data());
    swap_flown(string);
    return finite;
}

/// Ends a run that has not been shown since its last frame. Returns whether the string is finite.
bool move_to_end(const StringModel& model, Voice& voice) {
    EndRun& run = voice.run;
    if (run.passed == 0) return true;
    if (run.passed < longest_end_run) return move_on(model, voice);
    return kernels::end_long_run(run.modes, run.coefficients, run.zeta_m.data(),
                                 voice.string.displacement.data(), voice.string.velocity.data());
}

}  // namespace

EndRun make_end_run(const InstrumentModel& model, std::size_t stride) {
    EndRun run;
    if (model.bridge.count == 0) return run;
    EndCoefficients& of = run.coefficients;
    for (auto* array : {&of.trace, &of.determinant, &of.qq, &of.qv, &of.vq, &of.vv, &of.still, &of.q_last,
                        &of.v_last, &of.q_before, &of.v_before})
        array->assign(stride, 0.0);
    run.count = 1 + output_rows(model);
    run.responses.assign(run.count * end_run_stride, 0.0);
    run.readings.assign(run.count * end_run_stride, 0.0);
    return run;
}

bool goes_on_in_run(Voice& voice) JAWARI_REALTIME {
    EndRun& run = voice.run;
    if (run.frames == 0) return false;
    if (!goes_on_in_flight(voice.string, run.frames - run.passed)) {  // changed from outside
        run.frames = 0;
        run.shown = false;
        return false;
    }
    if (run.shown) swap_flown(voice.string);
    run.shown = false;
    return true;
}

bool begin_end_run(const EndFlyer& flyer, Voice& voice, std::size_t frames) JAWARI_REALTIME {
    EndRun& run = voice.run;
    StringState& string = voice.string;
    if (string.frame < run.not_before || !is_untouched(voice.touches)) return false;
    if (run.outdated) prepare(flyer, voice);
    const ForcedFlight flight = begin_forced_flight(flyer.string, string, shape_of(run), run.still_m, frames,
                                                    spare_travel * run.swing_m);
    if (flight.frames == 0) {
        run.not_before = string.frame + frames_until_next_try;
        return false;
    }
    run.frames = flight.frames;
    run.passed = 0;
    run.travel_m = 0;
    run.most_travel_m = flight.travel;
    run.modes = string.active_modes;
    read_flight(flyer, run, run.frames, string.displacement.data(), string.velocity.data(), run.readings);
    if (is_finite(run)) return true;
    run.frames = 0;
    end_forced_flight(flyer.string, string, true);  // the frame will see to it
    return false;
}

void pass_in_run(const StringModel& string, Voice& voice, double zeta_m) JAWARI_REALTIME {
    EndRun& run = voice.run;
    run.travel_m += std::abs(zeta_m - last_zeta(run));
    pass_in_flight(string, voice.string);
    kernels::add_end_response(run.count, run.frames - run.passed, zeta_m, run.responses.data(),
                              run.readings.data() + run.passed + 1);
    run.zeta_m[run.passed] = zeta_m;
    run.passed += 1;
}

void give_up_run(const StringModel& string, Voice& voice, double zeta_m) JAWARI_REALTIME {
    EndRun& run = voice.run;
    const double swing_m = run.travel_m + std::abs(zeta_m - last_zeta(run));
    settle_run(string, voice);
    run.swing_m = std::max(run.swing_m, swing_m);
    run.not_before = voice.string.frame + 1;
}

void read_run(const EndRun& run, std::size_t first, std::size_t frames,
              OutputReadings& readings) JAWARI_REALTIME {
    readings.count = run.count - 1;
    for (std::size_t t = 1; t < run.count; ++t)
        std::copy_n(run.readings.data() + t * end_run_stride + first, frames, readings.values[t - 1].data());
}

void note_end(EndRun& run, double zeta_m) JAWARI_REALTIME {
    run.swing_m = std::max(swing_kept * run.swing_m,
                           static_cast<double>(frames_until_next_try) * std::abs(zeta_m - run.still_m));
    run.still_m = zeta_m;
}

void settle_run(const StringModel& string, Voice& voice) JAWARI_REALTIME {
    EndRun& run = voice.run;
    if (run.frames == 0) return;
    const bool finite = run.shown ? run.finite : move_to_end(string, voice);
    if (run.passed > 0) {
        run.swing_m = std::max(run.travel_m, swing_kept * run.swing_m);
        run.still_m = last_zeta(run);
    }
    run.frames = 0;
    run.shown = false;
    end_forced_flight(string, voice.string, finite);
}

void show_run(const StringModel& string, Voice& voice) JAWARI_REALTIME {
    EndRun& run = voice.run;
    if (run.frames == 0 || run.shown) return;
    run.finite = move_on(string, voice);
    run.shown = true;
}

void forget_run(Voice& voice) JAWARI_REALTIME {
    EndRun& run = voice.run;
    if (run.frames > 0) voice.string.certificate.validity.odometers_at_frame = voice.string.frame;
    run.frames = 0;
    run.shown = false;
}

}  // namespace jawari
