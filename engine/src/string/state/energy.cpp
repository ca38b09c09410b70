#include "jawari/scene/energy.h"

#include <algorithm>
#include <cmath>

#include "string/kernels/mode_sums.h"
#include "string/model/compliant_law.h"
#include "string/state/metering.h"

namespace jawari {
namespace {

/// A state between steps: the modes, and twice the mean height of each obstacle over the step before.
struct Moment {
    const AlignedVector<double>& displacement;
    const AlignedVector<double>& velocity;
    bool one_step_earlier;
};

double stored_in_contacts(const StringModel& model, const ContactState& contact, const Moment& moment) {
    const StringShape& shape = *model.shape;
    double stored = 0;
    for (std::size_t c = 0; c < shape.contact_compliance.size(); ++c) {
        const Compliance& law = shape.contact_compliance[c];
        if (law.stiffness == 0) continue;
        const double* row = shape.contact_rows.data() + c * shape.stride;
        double place = 0;
        double rate = 0;
        kernels::row_products(1, shape.stride, shape.stride, row, moment.displacement.data(), &place);
        kernels::row_products(1, shape.stride, shape.stride, row, moment.velocity.data(), &rate);
        const double before = contact.height_before[c];
        const double heights =
            moment.one_step_earlier ? 2 * before - contact.height_rise_before[c] : contact.height[c] + before;
        stored += stored_energy(law, place - shape.step_s / 2 * rate - heights / 2);
    }
    return stored;
}

double energy_of(const StringModel& model, const ContactState& contact, const Moment& moment) {
    const double lag = model.shape->scheme == Scheme::Exact ? model.shape->step_s / 2 : 0.0;
    return kernels::energy(model.shape->stride, model.tuning.kinetic.data(), model.tuning.potential.data(),
                           lag, moment.displacement.data(), moment.velocity.data()) +
           stored_in_contacts(model, contact, moment);
}

double dissipated_in_step(const StringModel& model, const StringState& state) {
    const std::size_t n = model.shape->stride;
    const double* v_now = state.velocity.data();
    const double* v_before = state.velocity_before.data();
    if (model.shape->scheme == Scheme::Exact) {
        // mu sum (1-e)/(4w) (v+ + v)^2
        return kernels::weighted_square(n, model.shape->dissipation.data(), 1, v_now, 1, v_before);
    }
    // mu sum [2 sigma h v_theta^2 + (theta - 1/2) (Dv^2 + omega^2 Dq^2)]; kinetic = mu/2, potential = mu
    // omega^2/2
    const double theta = model.shape->theta;
    return kernels::weighted_square(n, model.shape->dissipation.data(), theta, v_now, 1 - theta, v_before) +
           (2 * theta - 1) *
               (kernels::weighted_square(n, model.tuning.kinetic.data(), 1, v_now, -1, v_before) +
                kernels::weighted_square(n, model.tuning.potential.data(), 1, state.displacement.data(), -1,
                                         state.displacement_before.data()));
}

struct StepWork {
    double contact = 0;
    double player = 0;
};

/// Work of the impulses over the span that each scheme's balance names: two steps for the exact scheme, one
/// for theta.
StepWork impulse_work(const StringModel& model, const StringState& state) {
    const ContactState& contact = state.contact;
    StepWork work;
    for (const auto c : contact.candidates) {
        const double impulse = contact.impulse[c];
        if (impulse <= 0) continue;
        const double* row = model.shape->contact_rows.data() + c * model.shape->stride;
        double rise_now = 0;
        double rise_before = 0;
        kernels::row_products(1, model.shape->stride, model.shape->stride, row, state.velocity.data(),
                              &rise_now);
        kernels::row_products(1, model.shape->stride, model.shape->stride, row, state.velocity_before.data(),
                              &rise_before);
        const double raised = contact.height[c] - contact.height_before[c];
        if (model.shape->scheme == Scheme::Exact) {
            const double raised_twice = raised + contact.height_rise_before[c];
            const double moved = model.shape->step_s * (rise_now + rise_before);  // S (q+ - q_before)
            work.contact += impulse * (moved - raised_twice) / (2 * model.shape->step_s);
            work.player += impulse * raised_twice / (2 * model.shape->step_s);
        } else {
            const double moved = model.shape->step_s *
                                 (model.shape->theta * rise_now + (1 - model.shape->theta) * rise_before);
            work.contact += impulse * (moved - raised) / model.shape->step_s;
            work.player += impulse * raised / model.shape->step_s;
        }
    }
    return work;
}

/// The excitation is an impulse h F on every mode, and works like one.
double force_work(const StringModel& model, const StringState& state) {
    const ExcitationState& excitation = state.excitation;
    if (!excitation.active) return 0;
    const double share = model.shape->scheme == Scheme::Exact ? 0.5 : model.shape->theta;
    const auto power = [&](const AlignedVector<double>& force) {
        double now = 0;
        double before = 0;
        kernels::row_products(1, model.shape->stride, model.shape->stride, force.data(),
                              state.velocity.data(), &now);
        kernels::row_products(1, model.shape->stride, model.shape->stride, force.data(),
                              state.velocity_before.data(), &before);
        return share * now + (1 - share) * before;
    };
    double work = power(excitation.held);
    if (excitation.ramps) work += static_cast<double>(excitation.elapsed) * power(excitation.ramp);
    return model.shape->step_s * work;
}

}  // namespace

double energy(const StringModel& model, const StringState& state) JAWARI_REALTIME {
    return energy_of(model, state.contact, {state.displacement, state.velocity, false});
}

void meter_step(const StringModel& model, StringState& state) JAWARI_REALTIME {
    EnergyMeter& meter = state.energy;
    if (!std::isfinite(energy(model, state))) return;  // the frame's check resets the string, the meters stay
    const Moment past{state.displacement_before, state.velocity_before, true};
    const Moment present{state.displacement, state.velocity, false};
    const double before = energy_of(model, state.contact, past);
    const double now = energy_of(model, state.contact, present);
    const double stored =
        stored_in_contacts(model, state.contact, present) - stored_in_contacts(model, state.contact, past);
    const double dissipated = dissipated_in_step(model, state);
    StepWork work = impulse_work(model, state);
    work.contact += stored;  // what contacts keep is not lost
    work.player += force_work(model, state);

    meter.highest = std::max(meter.highest, now);
    meter.dissipated += dissipated;
    meter.contact_work += work.contact;
    meter.player_work += work.player;
    meter.worst_imbalance =
        std::max(meter.worst_imbalance, std::abs(now - before + dissipated - work.contact - work.player));
    meter.worst_rise = std::max(meter.worst_rise, now - before - work.player);
}

void meter_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    state.energy.highest = std::max(state.energy.highest, energy(model, state));
}

}  // namespace jawari
