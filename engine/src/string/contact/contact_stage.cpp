#include "string/contact/contact_stage.h"

#include <algorithm>

#include "base/assert.h"
#include "jawari/detail/lcp.h"
#include "string/contact/compliant_contacts.h"
#include "string/contact/impact_law.h"
#include "string/kernels/mode_sums.h"
#include "string/kernels/response_sums.h"
#include "string/model/contact_response.h"

namespace jawari {
namespace {

ContactMoment moment_of(const StringModel& model, const ContactState& contact, std::size_t c) {
    ContactMoment moment;
    moment.gap = contact.gap[c];
    moment.gap_before = contact.gap_before[c];
    moment.approach = model.shape->step_s * contact.gap_rate[c];
    moment.restitution = model.shape->contact_restitution[c];
    moment.theta = model.shape->theta;
    moment.scheme = model.shape->scheme;
    moment.excused = excused_depth(model, contact);
    return moment;
}

/// y_free + A lambda - y_free at one contact.
double gap_response(const StringModel& model, const ContactState& contact, std::size_t c) {
    const ContactOperator A = compliance_of(model);
    double response = 0;
    for (const auto other : contact.candidates) {
        if (contact.impulse[other] > 0) response += A(c, other) * contact.impulse[other];
    }
    return response;
}

/// select_candidates() where all contacts are rigid and the law is Signorini's, which takes all of them for
/// candidates and asks for no more than the gap before.
bool select_all(const StringModel& model, ContactState& contact) {
    ContactMoment moment;
    moment.excused = excused_depth(model, contact);
    bool violated = false;
    for (const auto c : contact.near) {
        contact.candidates.push(c);
        moment.gap_before = contact.gap_before[c];
        contact.offset[c] = contact.gap_free[c] - target_gap(ImpactLaw::Signorini, moment);
        violated = violated || contact.offset[c] < 0;
    }
    return violated;
}

/// gaps <- gaps + A_c impulse at the near contacts.
void add_gap_responses(const ContactOperator& A, std::size_t active, ContactState& contact) {
    const double impulse = contact.impulse[active];
    double* const gaps = contact.gap.data();
    if (A.node != nullptr) {
        for (const auto c : contact.near) gaps[c] += A(active, c) * impulse;
        return;
    }
    const double* const row = A.values + active * A.stride;
    for (const auto c : contact.near) gaps[c] += row[c] * impulse;
}

/// out <- S x at the near contacts.
void near_products(const StringModel& model, StringState& state, const AlignedVector<double>& x,
                   AlignedVector<double>& out) {
    const ContactState& contact = state.contact;
    kernels::indexed_row_products(contact.near.data(), contact.near.size(), state.active_modes,
                                  model.shape->stride, model.shape->contact_rows.data(), x.data(),
                                  out.data());
}

}  // namespace

void make_passive(const StringModel& model, ContactState& contact) JAWARI_REALTIME {
    double linear = 0;
    double quadratic = 0;
    for (const auto c : contact.candidates) {
        const double impulse = contact.impulse[c];
        if (impulse <= 0) continue;
        linear += impulse * (contact.gap_free[c] - contact.gap_before[c]);
        quadratic += impulse * gap_response(model, contact, c);
    }
    const double scale = quadratic > 0 ? std::clamp(-linear / quadratic, 0.0, 1.0) : 0.0;
    for (const auto c : contact.candidates) contact.impulse[c] *= scale;
}

void place_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    near_products(model, state, state.displacement, contact.gap);
    near_products(model, state, state.velocity, contact.gap_rate);
    for (const auto c : contact.near) {
        contact.gap_before[c] =
            contact.gap[c] - model.shape->step_s * contact.gap_rate[c] - contact.height_before[c];
        contact.gap[c] -= contact.height[c];
    }
}

void join_step(const StringModel& model, StringState& state, std::size_t c) JAWARI_REALTIME {
    JAWARI_ASSERT(c < model.shape->contact_count);
    ContactState& contact = state.contact;
    const auto row_product = [&](const AlignedVector<double>& x) {
        const auto index = static_cast<std::uint32_t>(c);
        kernels::indexed_row_products(&index, 1, state.active_modes, model.shape->stride,
                                      model.shape->contact_rows.data(), x.data(), contact.residual.data());
        return contact.residual[c];
    };
    contact.gap[c] = row_product(state.displacement) - contact.height[c];
    contact.gap_before[c] = contact.gap[c] - model.shape->step_s * row_product(state.velocity_before);
    contact.gap_free[c] = contact.gap[c] + model.shape->step_s * row_product(state.velocity);
    contact.impulse[c] = 0;
    make_near(contact, c);
}

void move_obstacles(ContactState& contact) JAWARI_REALTIME {
    if (contact.moving_count == 0) return;
    std::size_t still_moving = 0;
    for (std::size_t c = 0; c < contact.height.size(); ++c) {
        const double rise_before = contact.height[c] - contact.height_before[c];
        contact.height_rise_before[c] = rise_before;
        contact.height_before[c] = contact.height[c];
        if (contact.moving_steps[c] > 0) {
            contact.moving_steps[c] -= 1;
            contact.height[c] = contact.moving_steps[c] == 0 ? contact.height_target[c]
                                                             : contact.height[c] + contact.height_rate[c];
            still_moving += 1;
        } else if (rise_before != 0) {
            still_moving += 1;  // the past of a movement fades out of the two-step balance
        }
    }
    contact.moving_count = still_moving;
}

void note_approach(const StringModel& model, StringState& state) JAWARI_REALTIME {
    near_products(model, state, state.velocity_before, state.contact.gap_rate);
}

void predict_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    const double h = model.shape->step_s;
    near_products(model, state, state.velocity, contact.gap_free);
    for (const auto c : contact.near) {
        const double raised = contact.height[c] - contact.height_before[c];
        const double rate =
            model.shape->theta * contact.gap_free[c] + (1 - model.shape->theta) * contact.gap_rate[c];
        contact.gap_free[c] = contact.gap[c] + h * rate - raised;
    }
}

bool select_candidates(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    const bool some_comply = has_compliant_contacts(model);
    contact.candidates.clear();
    contact.rigid.clear();
    contact.compliant.clear();
    if (!some_comply && model.shape->law == ImpactLaw::Signorini) return select_all(model, contact);
    bool violated = false;
    for (const auto c : contact.near) {
        if (some_comply && is_compliant(model, c)) {
            contact.candidates.push(c);
            contact.compliant.push(c);
            violated = violated || presses_alone(model, contact, c);
            continue;
        }
        const ContactMoment moment = moment_of(model, contact, c);
        if (!is_candidate(model.shape->law, moment)) {
            contact.impulse[c] = 0;
            continue;
        }
        contact.candidates.push(c);
        if (some_comply) contact.rigid.push(c);
        contact.offset[c] = contact.gap_free[c] - target_gap(model.shape->law, moment);
        violated = violated || contact.offset[c] < 0;
    }
    return violated;
}

void clear_impulses(StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    for (const auto c : contact.near) contact.impulse[c] = 0;
}

void solve_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME {
    if (has_compliant_contacts(model)) {
        solve_compliant_contacts(model, state);
        return;
    }
    ContactState& contact = state.contact;
    Counters& counters = state.counters;
    const LcpOutcome outcome = solve_lcp(compliance_of(model), contact.offset, contact.candidates.span(),
                                         contact.impulse, contact.residual, state.lcp);
    counters.solves += 1;
    contact.left_open = outcome.finished ? outcome.residual : 0.0;
    if (outcome.finished) {
        counters.worst_residual_m = std::max(counters.worst_residual_m, outcome.residual);
    } else {
        counters.truncated_solves += 1;
        make_passive(model, contact);
    }
}

void apply_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME {
    const ContactState& contact = state.contact;
    kernels::add_impulses(contact.candidates.data(), contact.candidates.size(), contact.impulse.data(),
                          model.shape->stride, model.shape->stride, model.shape->mobility.data(),
                          model.shape->contact_rows.data(), state.velocity.data());
}

void accept_gaps(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    for (const auto c : contact.near) {
        contact.gap_before[c] = contact.gap[c];
        contact.gap[c] = contact.gap_free[c];
    }
    const ContactOperator A = compliance_of(model);
    std::size_t impulses = 0;
    for (const auto active : contact.candidates) {
        if (contact.impulse[active] <= 0) continue;
        contact.frame_impulse[active] += contact.impulse[active];
        impulses += 1;
    }
    state.counters.impulses += impulses;
    if (impulses > kernels::few_sources) {
        kernels::add_responses(A, contact.candidates.span(), contact.impulse.data(), contact.near.span(),
                               contact.gap.data());
    } else {
        for (const auto active : contact.candidates) {
            if (contact.impulse[active] <= 0) continue;
            add_gap_responses(A, active, contact);
        }
    }
    state.counters.candidates += contact.candidates.size();
    const bool some_comply = has_compliant_contacts(model);
    double deepest = state.counters.worst_penetration_m;
    for (const auto c : contact.near) {
        if (some_comply && is_compliant(model, c)) continue;
        deepest = std::max(deepest, -contact.gap[c]);
    }
    state.counters.worst_penetration_m = deepest;
}

}  // namespace jawari
