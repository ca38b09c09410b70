#include "string/broad_phase/pushed_contacts.h"

#include <limits>

#include "string/broad_phase/gap_bounds.h"
#include "string/contact/contact_stage.h"

namespace jawari {
namespace {

/// What the step's impulses may move a group's gaps until the frame's end.
double push_of_step(const StringModel& model, const StringState& state, std::size_t g) {
    const ContactState& contact = state.contact;
    const double* push = model.shape->certificate.push_speed.data() + g * model.shape->contact_count;
    double speed = 0;
    for (const auto c : contact.candidates) speed += push[c] * contact.impulse[c];
    const double time_left = model.shape->step_s * static_cast<double>(state.steps_left) + lookahead(model);
    return bound_safety * model.tuning.certificate.push_growth * speed * time_left;
}

}  // namespace

bool admit_pushed_contacts(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    if (contact.near.size() == model.shape->contact_count) return false;
    GapBounds& bounds = state.certificate.bounds;
    bool admitted = false;
    for (std::size_t g = 0; g < group_count(model); ++g) {
        const double push = bounds.group_push[g] + push_of_step(model, state, g);
        if (bounds.group_margin[g] > push) continue;
        double smallest = std::numeric_limits<double>::infinity();
        for (const std::size_t c : contacts_of(model, g)) {
            if (contact.is_near[c] != 0) continue;
            if (bounds.margin[c] > push) {
                smallest = std::min(smallest, bounds.margin[c]);
                continue;
            }
            join_step(model, state, c);
            admitted = true;
        }
        bounds.group_margin[g] = smallest;
    }
    return admitted;
}

void charge_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME {
    state.certificate.validity.outdated = true;
    if (state.contact.near.size() == model.shape->contact_count) return;
    std::vector<double>& push = state.certificate.bounds.group_push;
    for (std::size_t g = 0; g < group_count(model); ++g) push[g] += push_of_step(model, state, g);
}

}  // namespace jawari
