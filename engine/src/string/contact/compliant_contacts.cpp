#include "string/contact/compliant_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/assert.h"
#include "jawari/detail/lcp.h"
#include "string/contact/contact_stage.h"
#include "string/model/compliant_law.h"
#include "string/model/contact_response.h"

namespace jawari {
namespace {

/// A round that moves no gap by more than this share of the largest gap and rise is the last.
constexpr double settled = 4 * std::numeric_limits<double>::epsilon();

CompliantMoment compliant_moment(const StringModel& model, const ContactState& contact, std::size_t c) {
    return {contact.gap[c], contact.gap_before[c], model.shape->step_s};
}

double response(const ContactOperator& A, std::size_t c, const IndexList& sources,
                const AlignedVector<double>& impulse) {
    double sum = 0;
    for (const auto source : sources) {
        if (impulse[source] > 0) sum += A(c, source) * impulse[source];
    }
    return sum;
}

/// One sweep of Gauss and Seidel over the compliant contacts: each takes the impulse that its law asks for,
/// given the others. It minimises a convex function coordinate by coordinate, so it converges. Returns
/// whether it moved nothing.
bool sweep(const StringModel& model, ContactState& contact) {
    const ContactOperator A = compliance_of(model);
    bool moved = false;
    for (const auto c : contact.compliant) {
        double& impulse = contact.compliant_impulse[c];
        const double others = response(A, c, contact.rigid, contact.impulse) +
                              response(A, c, contact.compliant, contact.compliant_impulse) -
                              A(c, c) * impulse;
        const double found =
            compliant_impulse(model.shape->contact_compliance[c], compliant_moment(model, contact, c),
                              contact.gap_free[c] + others, A(c, c));
        const double size = std::abs(contact.gap_free[c]) + std::abs(others) + A(c, c) * found;
        moved = moved || A(c, c) * std::abs(found - impulse) > settled * size;
        impulse = found;
    }
    return !moved;
}

/// impulse <- the rigid contacts' impulses, given those of the compliant ones. Returns false if the solve was
/// truncated.
bool solve_rigid(const StringModel& model, StringState& state) {
    ContactState& contact = state.contact;
    const ContactOperator A = compliance_of(model);
    bool violated = false;
    for (const auto c : contact.rigid) {
        contact.gap_rate[c] =
            contact.offset[c] + response(A, c, contact.compliant, contact.compliant_impulse);
        violated = violated || contact.gap_rate[c] < 0;
    }
    if (!violated) {
        for (const auto c : contact.rigid) contact.impulse[c] = 0;
        return true;
    }
    const LcpOutcome outcome =
        solve_lcp(A, contact.gap_rate, contact.rigid.span(), contact.impulse, contact.residual, state.lcp);
    contact.left_open = outcome.finished ? outcome.residual : 0.0;
    if (outcome.finished)
        state.counters.worst_residual_m = std::max(state.counters.worst_residual_m, outcome.residual);
    return outcome.finished;
}

/// Every contact as a rigid one that may not end the step deeper than it was one step before it: no contact
/// then gives energy to the string (docs/engine/stability.md, "Compliant contacts").
void hold_places(const StringModel& model, StringState& state) {
    ContactState& contact = state.contact;
    for (const auto c : contact.compliant) contact.offset[c] = contact.gap_free[c] - contact.gap_before[c];
    for (const auto c : contact.candidates) contact.impulse[c] = 0;
    const LcpOutcome outcome = solve_lcp(compliance_of(model), contact.offset, contact.candidates.span(),
                                         contact.impulse, contact.residual, state.lcp);
    if (!outcome.finished) make_passive(model, contact);
}

}  // namespace

bool is_compliant(const StringModel& model, std::size_t contact) JAWARI_REALTIME {
    JAWARI_ASSERT(has_compliant_contacts(model));
    return !is_rigid(model.shape->contact_compliance[contact]);
}

bool presses_alone(const StringModel& model, const ContactState& contact, std::size_t c) JAWARI_REALTIME {
    return compliant_force(model.shape->contact_compliance[c], compliant_moment(model, contact, c),
                           contact.gap_free[c]) > 0;
}

void solve_compliant_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    state.counters.solves += 1;
    contact.left_open = 0;
    for (const auto c : contact.compliant) {
        contact.compliant_impulse[c] = contact.impulse[c];  // of the last step: the guess
        contact.impulse[c] = 0;
    }
    bool done = false;
    for (int round = 0; round < most_compliant_rounds && !done; ++round) {
        if (!solve_rigid(model, state)) break;
        done = sweep(model, contact);
    }
    if (done) {
        for (const auto c : contact.compliant) contact.impulse[c] = contact.compliant_impulse[c];
        return;
    }
    state.counters.truncated_solves += 1;
    hold_places(model, state);
}

}  // namespace jawari
