// Compliant contacts beside rigid ones in one step: the impulses that satisfy both kinds of law at once.
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

inline bool has_compliant_contacts(const StringModel& model) {
    return !model.shape->contact_compliance.empty();
}

/// Precondition: has_compliant_contacts(model).
bool is_compliant(const StringModel& model, std::size_t contact) JAWARI_REALTIME;

/// Whether a compliant contact would press if nothing else acted in the step.
bool presses_alone(const StringModel& model, const ContactState& contact, std::size_t c) JAWARI_REALTIME;

/// impulse <- what satisfies the law of each contact of ContactState::rigid and the force law of each of
/// ContactState::compliant. Bounded: rounds of both in turn, at most most_compliant_rounds; if they do not
/// settle, compliant contacts hold their places for this step, which takes no energy from or into them, and
/// the solve counts as truncated.
void solve_compliant_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Rounds after which solve_compliant_contacts() gives up.
inline constexpr int most_compliant_rounds = 100;

}  // namespace jawari
