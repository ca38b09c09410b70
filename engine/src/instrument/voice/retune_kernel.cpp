#include "instrument/voice/retune_kernel.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "instrument/voice/retune_kernel.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace jawari::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<double>;
using Vec = hn::Vec<Lanes>;

/// Numbers of one group of modes.
struct Step {
    HWY_INLINE Step() {}  // NOLINT(modernize-use-equals-default): written out so that it is compiled for the
                          // target, as Vec's own is
    Vec omega2, e, d, s, mobility;
    Vec qq, qv, vq, vv;
    Vec backward_q, backward_u;
};

/// The formulas of exact_factors(), flight_factors() and exact_backward_velocity(), underdamped.
HWY_INLINE Step step_of(Vec omega2, Vec sigma, Vec loss, Vec frame_loss, double h, double m) {
    const Lanes d;
    const Vec one = hn::Set(d, 1.0);
    const Vec two = hn::Set(d, 2.0);
    const Vec W = hn::Sqrt(hn::Sub(omega2, hn::Mul(sigma, sigma)));
    const Vec half = hn::Mul(W, hn::Set(d, h / 2));
    const Vec half_frame = hn::Mul(W, hn::Set(d, h * m / 2));
    const Vec sine = hn::Sin(d, half);
    const Vec cosine = hn::Cos(d, half);
    const Vec frame_sine = hn::Sin(d, half_frame);
    const Vec frame_cosine = hn::Cos(d, half_frame);
    const Vec decay = hn::Add(one, loss);              // exp(-sigma h)
    const Vec frame_decay = hn::Add(one, frame_loss);  // exp(-sigma m h)
    const Vec turn = hn::Mul(hn::Set(d, 4.0), decay);
    const Vec sine2 = hn::Mul(sine, sine);
    Step step;
    step.omega2 = omega2;
    step.e = hn::Mul(decay, decay);
    step.d = hn::MulAdd(turn, sine2, hn::Mul(loss, loss));
    step.s = hn::MulAdd(turn, hn::Mul(cosine, cosine), hn::Mul(loss, loss));
    const Vec sine_of_step = hn::Mul(two, hn::Mul(sine, cosine));
    const Vec sine_of_frame = hn::Mul(two, hn::Mul(frame_sine, frame_cosine));
    const Vec psi = hn::Div(hn::Mul(hn::Div(frame_decay, decay), sine_of_frame), sine_of_step);
    const Vec trace = hn::NegMulAdd(hn::Mul(two, frame_decay), hn::Mul(frame_sine, frame_sine), frame_loss);
    const Vec one_minus_e = hn::Neg(hn::Mul(loss, hn::Add(two, loss)));
    const Vec difference = hn::Mul(hn::Mul(psi, hn::Sub(one_minus_e, step.d)), hn::Set(d, 0.5));
    step.qq = hn::Add(trace, difference);
    step.vv = hn::Sub(trace, difference);
    step.qv = hn::Mul(hn::Set(d, h), hn::Mul(step.e, psi));
    step.vq = hn::Mul(hn::Set(d, -1 / h), hn::Mul(step.d, psi));
    const Vec growth = hn::Div(one, decay);
    const Vec per_u = hn::Div(hn::Mul(growth, sine_of_step), hn::Mul(W, hn::Set(d, h)));
    step.backward_u = per_u;
    step.backward_q =
        hn::MulAdd(sigma, per_u,
                   hn::Mul(hn::Set(d, 1 / h),
                           hn::Mul(growth, hn::MulAdd(two, sine2, loss))));  // -expm1(sigma h) = growth loss
    return step;
}

/// What FlightModel has of a force on the mode.
struct ForceResponse {
    HWY_INLINE ForceResponse() {}  // NOLINT(modernize-use-equals-default): as Step()
    Vec q_held, v_held, q_ramp, v_ramp;
};

/// The formulas of the force response of free flight (docs/engine/model.md); per_d = 1/d.
HWY_INLINE ForceResponse force_response_of(const Step& step, Vec mobility, Vec per_d, double h, double m) {
    const Lanes d;
    const Vec alpha = hn::Mul(hn::Set(d, h * h), hn::Mul(mobility, per_d));
    const Vec beta = hn::Mul(hn::Mul(hn::Sub(step.e, hn::Set(d, 1.0)), alpha), per_d);
    const Vec alpha_rate = hn::Mul(alpha, hn::Set(d, 1 / h));
    ForceResponse force;
    force.q_held = hn::Neg(hn::Mul(step.qq, alpha));
    force.v_held = hn::Neg(hn::Mul(step.vq, alpha));
    force.q_ramp =
        hn::NegMulAdd(step.qv, alpha_rate, hn::NegMulAdd(step.qq, beta, hn::Mul(alpha, hn::Set(d, m))));
    force.v_ramp = hn::Neg(hn::MulAdd(step.vq, beta, hn::Mul(step.vv, alpha_rate)));
    return force;
}

/// Without `strikes` the string has no contacts, and what tells how its gaps move stays.
template <bool strikes>
void retune_string(const StoppedStringModel& base, const Retuning& retuning, StringTuning& bent,
                   double* HWY_RESTRICT backward_q, double* HWY_RESTRICT backward_u,
                   const double* HWY_RESTRICT q, double* HWY_RESTRICT v) {
    const Lanes d;
    const StringShape& shape = *base.string.shape;
    const StringTuning& from = base.string.tuning;
    const double h = shape.step_s;
    const auto m = static_cast<double>(shape.steps_per_frame);
    const Vec zero = hn::Zero(d);
    const Vec one = hn::Set(d, 1.0);
    const Vec h2 = hn::Set(d, h * h);
    const Vec highest2 = hn::Set(d, retuning.highest_omega * retuning.highest_omega);
    Vec reach_growth = one, kick_growth = one;
    for (std::size_t k = 0; k < shape.stride; k += hn::Lanes(d)) {
        const Vec number = hn::Add(hn::Iota(d, static_cast<double>(k)), one);
        const Vec omega = hn::Load(d, from.omega.data() + k);
        const Vec sigma = hn::Load(d, shape.sigma.data() + k);
        const Vec omega2 = hn::Mul(omega, omega);
        const Vec wanted = hn::MulAdd(hn::Set(d, retuning.rise), hn::Mul(number, number), omega2);
        const Vec bent2 = hn::Min(wanted, hn::Max(omega2, highest2));
        const Vec damped2 = hn::Mul(sigma, hn::Mul(sigma, hn::Set(d, 1.0001)));
        const auto bends =
            hn::And(hn::Gt(omega, zero), hn::And(hn::Gt(bent2, damped2), hn::Gt(omega2, damped2)));
        const Step step =
            step_of(hn::IfThenElse(bends, bent2, one), hn::IfThenElse(bends, sigma, zero),
                    hn::Load(d, base.loss_step.data() + k), hn::Load(d, base.loss_frame.data() + k), h, m);
        // The mobility stays, so that the Delassus operator does: the modal mass of the highest modes changes
        // by a fraction of a percent instead (docs/engine/model.md).
        const Vec mobility = hn::Load(d, shape.mobility.data() + k);
        const Vec per_d = hn::Div(one, step.d);
        const ForceResponse force = force_response_of(step, mobility, per_d, h, m);
        const auto keep = [&](Vec value, const AlignedVector<double>& old, AlignedVector<double>& out) {
            hn::Store(hn::IfThenElse(bends, value, hn::Load(d, old.data() + k)), d, out.data() + k);
        };
        keep(hn::Sqrt(step.omega2), from.omega, bent.omega);
        keep(hn::Mul(hn::Set(d, -1 / h), step.d), from.restoring, bent.restoring);
        keep(step.qq, from.flight.qq, bent.flight.qq);
        keep(step.qv, from.flight.qv, bent.flight.qv);
        keep(step.vq, from.flight.vq, bent.flight.vq);
        keep(step.vv, from.flight.vv, bent.flight.vv);
        keep(force.q_held, from.flight.q_held, bent.flight.q_held);
        keep(force.v_held, from.flight.v_held, bent.flight.v_held);
        keep(force.q_ramp, from.flight.q_ramp, bent.flight.q_ramp);
        keep(force.v_ramp, from.flight.v_ramp, bent.flight.v_ramp);
        keep(hn::Div(step.s, hn::Mul(hn::Set(d, 8.0), mobility)), from.kinetic, bent.kinetic);
        const Vec potential = hn::Div(step.d, hn::Mul(hn::Mul(hn::Set(d, 2.0), mobility), h2));
        keep(potential, from.potential, bent.potential);
        CertificateTuning& certificate = bent.certificate;
        const Vec stiffness = hn::Div(hn::Mul(hn::Set(d, 4.0), step.d), hn::Mul(step.s, h2));
        keep(stiffness, from.certificate.stiffness, certificate.stiffness);
        const Vec extent =
            hn::Sqrt(hn::Mul(hn::Mul(h2, hn::Set(d, 0.5)), hn::Mul(hn::Add(one, step.e), per_d)));
        if constexpr (strikes) {
            const Vec quality = hn::Div(hn::Add(one, step.e), step.s);
            const Vec lost = hn::Sub(one, step.e);
            const Vec lost_and_turned = hn::Add(lost, step.d);
            const Vec acceleration =  // times 2h, docs/engine/certificate.md, section 2
                hn::Add(lost,
                        hn::Sqrt(hn::MulAdd(lost_and_turned, lost_and_turned, hn::Mul(step.d, step.s))));
            const Vec sagitta = hn::Mul(hn::Set(d, h * m * m / 16), acceleration);
            keep(extent, from.certificate.extent, certificate.extent);
            const Vec detour = hn::Min(sagitta, hn::Add(extent, extent));
            keep(detour, from.certificate.detour, certificate.detour);
            const Vec kick = hn::Mul(hn::Sqrt(hn::Mul(hn::Set(d, 2.0), quality)), mobility);
            keep(kick, from.certificate.kick, certificate.kick);
            const auto was = [&](const AlignedVector<double>& old) { return hn::Load(d, old.data() + k); };
            const auto growth = [&](Vec now, Vec before) {
                return hn::IfThenElse(bends, hn::Div(now, before), one);
            };
            const Vec energy_growth = hn::Div(growth(stiffness, was(from.certificate.stiffness)),
                                              growth(potential, was(from.potential)));
            const Vec length_growth = hn::Max(growth(extent, was(from.certificate.extent)),
                                              growth(detour, was(from.certificate.detour)));
            reach_growth =
                hn::Max(reach_growth, hn::Mul(energy_growth, hn::Mul(length_growth, length_growth)));
            kick_growth = hn::Max(kick_growth, growth(kick, was(from.certificate.kick)));
        }
        const Vec old_u = hn::Load(d, backward_u + k);
        const Vec old_q = hn::Load(d, backward_q + k);
        const Vec share = hn::Div(step.backward_u, old_u);
        const Vec moved =
            hn::MulAdd(share, hn::Load(d, v + k),
                       hn::Mul(hn::NegMulAdd(share, old_q, step.backward_q), hn::Load(d, q + k)));
        hn::Store(hn::IfThenElse(bends, moved, hn::Load(d, v + k)), d, v + k);
        hn::Store(hn::IfThenElse(bends, step.backward_u, old_u), d, backward_u + k);
        hn::Store(hn::IfThenElse(bends, step.backward_q, old_q), d, backward_q + k);
    }
    if constexpr (!strikes) return;
    bent.certificate.reach_growth = std::sqrt(hn::GetLane(hn::MaxOfLanes(d, reach_growth)));
    bent.certificate.push_growth = hn::GetLane(hn::MaxOfLanes(d, kick_growth));
    bent.certificate.force_reach = from.certificate.force_reach * bent.certificate.push_growth;
}

void retune(const StoppedStringModel& base, const Retuning& retuning, StringTuning& bent, double* backward_q,
            double* backward_u, const double* q, double* v) {
    const auto retune_it = base.string.shape->contact_count > 0 ? retune_string<true> : retune_string<false>;
    retune_it(base, retuning, bent, backward_q, backward_u, q, v);
}

}  // namespace jawari::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace jawari::kernels {

HWY_EXPORT(retune);

void retune(const StoppedStringModel& base, const Retuning& retuning, StringTuning& bent, double* backward_q,
            double* backward_u, const double* q, double* v) noexcept {
    HWY_DYNAMIC_DISPATCH(retune)(base, retuning, bent, backward_q, backward_u, q, v);
}

}  // namespace jawari::kernels
#endif
