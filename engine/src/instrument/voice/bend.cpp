#include "instrument/voice/bend.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

kernels::Retuning retuning_of(const StoppedStringModel& stopped, double semitones) {
    const double ratio = std::exp2(semitones / 12);
    const double B = stopped.inharmonicity;
    const double tension = std::max(slackest, ratio * ratio * (1 + B) - B);
    const double omega = stopped.string.omega[0];
    return {(tension - 1) * omega * omega / (1 + B),
            highest_share * std::numbers::pi / stopped.string.step_s};
}

/// What does not depend on the tension. Storage is there; large tables are shared.
void adopt(const StringModel& base, StringModel& bent) {
    bent.length_m = base.length_m;
    bent.linear_density_kg_per_m = base.linear_density_kg_per_m;
    bent.mode_count = base.mode_count;
    bent.stride = base.stride;
    bent.step_s = base.step_s;
    bent.theta = base.theta;
    bent.scheme = base.scheme;
    bent.law = base.law;
    bent.steps_per_frame = base.steps_per_frame;
    bent.sigma = base.sigma;
    bent.carry = base.carry;
    bent.change = base.change;
    bent.mobility = base.mobility;
    bent.dissipation = base.dissipation;
    bent.certificate.group_begin = base.certificate.group_begin;
    bent.certificate.envelope = base.certificate.envelope;
    bent.certificate.reach = base.certificate.reach;
    bent.certificate.push = base.certificate.push_speed;
    bent.response_stride = base.response_stride;
    bent.contact_count = base.contact_count;
    bent.contact_stride = base.contact_stride;
    bent.contact_rows = base.contact_rows;
    bent.contact_columns = base.contact_columns;
    bent.contact_height = base.contact_height;
    bent.gap_rounding_m = base.gap_rounding_m;
    bent.contact_restitution = base.contact_restitution;
    bent.contact_position = base.contact_position;
    bent.contact_side = base.contact_side;
    bent.compliance = base.compliance;
    bent.grid_intervals = base.grid_intervals;
    bent.grid_node = base.grid_node;
    bent.rest_displacement = base.rest_displacement;
}

void reserve(StringModel& bent, const StringSizes& sizes) {
    FlightModel& f = bent.flight;
    CertificateModel& c = bent.certificate;
    for (auto* array : {&bent.omega,
                        &bent.sigma,
                        &bent.carry,
                        &bent.change,
                        &bent.restoring,
                        &bent.mobility,
                        &bent.kinetic,
                        &bent.potential,
                        &bent.dissipation,
                        &f.qq,
                        &f.qv,
                        &f.vq,
                        &f.vv,
                        &f.q_held,
                        &f.v_held,
                        &f.q_ramp,
                        &f.v_ramp,
                        &c.stiffness,
                        &c.extent,
                        &c.detour,
                        &c.kick,
                        &bent.rest_displacement}) {
        array->assign(sizes.stride, 0.0);
    }
    c.group_begin.reserve(sizes.groups + 1);
    c.reach.reserve(sizes.contacts);
    if (sizes.contacts <= contacts_with_own_bounds) c.push.reserve(sizes.contacts * sizes.contacts);
    bent.contact_height.reserve(sizes.contacts);
    bent.contact_restitution.reserve(sizes.contacts);
    bent.contact_position.reserve(sizes.contacts);
    bent.contact_side.reserve(sizes.contacts);
    bent.grid_node.reserve(sizes.contacts);
}

void begin(const StoppedStringModel& stopped, Voice& voice) {
    BendState& bend = voice.bend;
    adopt(stopped.string, bend.model);
    std::copy(stopped.backward_q.begin(), stopped.backward_q.end(), bend.backward_q.begin());
    std::copy(stopped.backward_u.begin(), stopped.backward_u.end(), bend.backward_u.begin());
    bend.active = true;
    // There is no response table at this tension: where frames are not short, near ones are stepped, with all
    // contacts if it is not known how impulses push those that are not near.
    voice.string.skipping.near = !bend.model.certificate.push.empty();
}

void restore(const StoppedStringModel& stopped, Voice& voice) {
    BendState& bend = voice.bend;
    StringState& string = voice.string;
    for (std::size_t k = 0; k < stopped.string.mode_count; ++k) {
        const double share = stopped.backward_u[k] / bend.backward_u[k];
        string.velocity[k] = share * string.velocity[k] +
                             (stopped.backward_q[k] - share * bend.backward_q[k]) * string.displacement[k];
    }
    forget_bend(voice);
}

}  // namespace

void set_retuning_tables(StoppedStringModel& stopped) {
    const StringModel& model = stopped.string;
    const double h = model.step_s;
    for (auto* array : {&stopped.loss_step, &stopped.loss_frame, &stopped.backward_q, &stopped.backward_u})
        array->assign(model.stride, 0.0);
    std::fill(stopped.backward_u.begin(), stopped.backward_u.end(), 1.0);
    for (std::size_t k = 0; k < model.mode_count; ++k) {
        const double sigma = model.sigma[k];
        stopped.loss_step[k] = std::expm1(-sigma * h);
        stopped.loss_frame[k] = std::expm1(-sigma * h * static_cast<double>(model.steps_per_frame));
        if (sigma >= model.omega[k]) continue;  // overdamped: never converted
        const double W = std::sqrt((model.omega[k] - sigma) * (model.omega[k] + sigma));
        const double growth = std::exp(sigma * h);
        const double half_sine = std::sin(W * h / 2);
        stopped.backward_u[k] = growth * std::sin(W * h) / (W * h);
        stopped.backward_q[k] =
            (growth * 2 * half_sine * half_sine - std::expm1(sigma * h)) / h + sigma * stopped.backward_u[k];
    }
}

BendState make_bend_state(const StringSizes& sizes) {
    BendState bend;
    reserve(bend.model, sizes);
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
        kernels::retune(stopped, retuning_of(stopped, semitones), bend.model, bend.backward_q.data(),
                        bend.backward_u.data(), string.displacement.data(), string.velocity.data());
        bend.semitones = semitones;
    }
    const double work_J = energy(bend.active ? bend.model : stopped.string, string) - before;
    if (std::isfinite(work_J)) work.bends_J += work_J;
    voice.touches.outdated = true;
    forget_bounds(string);
    forget_responses(string);
}

void forget_bend(Voice& voice) JAWARI_REALTIME {
    voice.bend.active = false;
    voice.bend.semitones = 0;
    voice.string.skipping.near = true;
}

}  // namespace jawari
