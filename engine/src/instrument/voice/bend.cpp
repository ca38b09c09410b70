#include "instrument/voice/bend.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/square.h"
#include "instrument/voice/bridge_model.h"
#include "instrument/voice/retune_kernel.h"
#include "jawari/scene/energy.h"
#include "string/broad_phase/gap_bounds.h"
#include "string/broad_phase/gap_certificate.h"
#include "string/frame/short_frame.h"

namespace jawari {
namespace {

/// Tension does not fall below this share of the compiled one.
constexpr double slackest = 0.01;
/// No mode rises above this share of the step's Nyquist rate.
constexpr double highest_share = 0.95;

/// Tension over the compiled one.
double tension_growth(const StoppedStringModel& stopped, double semitones) {
    const double ratio = std::exp2(semitones / 12);
    const double B = stopped.inharmonicity;
    return std::max(slackest, ratio * ratio * (1 + B) - B);
}

kernels::Retuning retuning_of(const StoppedStringModel& stopped, double semitones) {
    const double B = stopped.inharmonicity;
    const double tension = tension_growth(stopped, semitones);
    const double omega = stopped.string.tuning.omega[0];
    return {(tension - 1) * omega * omega / (1 + B),
            highest_share * std::numbers::pi / stopped.string.shape->step_s};
}

// The compiler sees that the last holder of a shape would free it; none here is the last.
#if defined(__clang__) && __clang_major__ >= 20
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wfunction-effects"
#endif
/// The instrument's model outlives the voices played on it and holds every shape, so that nothing is freed
/// here. Copying the pointer allocates nothing: one holder more, and one less of the shape before.
void share_shape(const StringModel& compiled, StringModel& bent) JAWARI_REALTIME {
    bent.shape = compiled.shape;
}
#if defined(__clang__) && __clang_major__ >= 20
#pragma clang diagnostic pop
#endif

void begin(const StoppedStringModel& stopped, Voice& voice) {
    BendState& bend = voice.bend;
    share_shape(stopped.string, bend.model);
    std::copy(stopped.backward_q.begin(), stopped.backward_q.end(), bend.backward_q.begin());
    std::copy(stopped.backward_u.begin(), stopped.backward_u.end(), bend.backward_u.begin());
    bend.active = true;
}

void restore(const StoppedStringModel& stopped, Voice& voice) {
    BendState& bend = voice.bend;
    StringState& string = voice.string;
    for (std::size_t k = 0; k < stopped.string.shape->mode_count; ++k) {
        const double share = stopped.backward_u[k] / bend.backward_u[k];
        string.velocity[k] = share * string.velocity[k] +
                             (stopped.backward_q[k] - share * bend.backward_q[k]) * string.displacement[k];
    }
    forget_bend(voice);
}

/// The end at a moving bridge pulls and resists as the tension does.
void set_end_tension(const StoppedStringModel& stopped, Voice& voice) {
    if (stopped.bridge_stiffness_N_per_m == 0) return;
    const double tension_N =
        square(stopped.wave_impedance_kg_per_s) / stopped.string.shape->linear_density_kg_per_m;
    voice.bend.growth = tension_growth(stopped, voice.bend.semitones);
    voice.bend.bridge_stiffness_N_per_m =
        end_stiffness(voice.bend.model, stopped.end_row.data(), tension_N, voice.bend.growth);
}

}  // namespace

void set_retuning_tables(StoppedStringModel& stopped) {
    const StringShape& shape = *stopped.string.shape;
    const double h = shape.step_s;
    for (auto* array : {&stopped.loss_step, &stopped.loss_frame, &stopped.backward_q, &stopped.backward_u})
        array->assign(shape.stride, 0.0);
    std::fill(stopped.backward_u.begin(), stopped.backward_u.end(), 1.0);
    for (std::size_t k = 0; k < shape.mode_count; ++k) {
        const double omega = stopped.string.tuning.omega[k];
        const double sigma = shape.sigma[k];
        stopped.loss_step[k] = std::expm1(-sigma * h);
        stopped.loss_frame[k] = std::expm1(-sigma * h * static_cast<double>(shape.steps_per_frame));
        if (sigma >= omega) continue;  // overdamped: never converted
        const double W = std::sqrt((omega - sigma) * (omega + sigma));
        const double growth = std::exp(sigma * h);
        const double half_sine = std::sin(W * h / 2);
        stopped.backward_u[k] = growth * std::sin(W * h) / (W * h);
        stopped.backward_q[k] =
            (growth * 2 * half_sine * half_sine - std::expm1(sigma * h)) / h + sigma * stopped.backward_u[k];
    }
}

// A new member of StringTuning: does mode_arrays() name it, and does kernels::retune() fill it?
static_assert(sizeof(StringTuning) ==
                  sizeof(FlightModel) + sizeof(CertificateTuning) + 6 * sizeof(AlignedVector<double>) &&
              sizeof(CertificateTuning) ==
                  4 * sizeof(AlignedVector<double>) + sizeof(std::vector<double>) + 3 * sizeof(double));

BendState make_bend_state(const StringSizes& sizes) {
    BendState bend;
    for (AlignedVector<double>* array : mode_arrays(bend.model.tuning)) array->assign(sizes.stride, 0.0);
    bend.backward_q.assign(sizes.stride, 0.0);
    bend.backward_u.assign(sizes.stride, 0.0);
    return bend;
}

void set_bend(const StoppedStringModel& stopped, Voice& voice, double semitones,
              PlayerWork& work) JAWARI_REALTIME {
    BendState& bend = voice.bend;
    if (semitones == bend.semitones) return;
    StringState& string = voice.string;
    const double before = energy(bend.active ? bend.model : stopped.string, string);
    if (semitones == 0) {
        restore(stopped, voice);
    } else {
        if (!bend.active) begin(stopped, voice);
        kernels::retune(stopped, retuning_of(stopped, semitones), bend.model.tuning, bend.backward_q.data(),
                        bend.backward_u.data(), string.displacement.data(), string.velocity.data());
        bend.semitones = semitones;
        set_end_tension(stopped, voice);
    }
    const double work_J = energy(bend.active ? bend.model : stopped.string, string) - before;
    if (std::isfinite(work_J)) work.bends_J += work_J;
    voice.touches.outdated = true;
    voice.run.outdated = true;
    forget_bounds(string);
    forget_responses(string);
}

void forget_bend(Voice& voice) JAWARI_REALTIME {
    voice.bend.active = false;
    voice.bend.semitones = 0;
}

}  // namespace jawari
