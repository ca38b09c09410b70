#include "string/broad_phase/pushed_contacts.h"

#include <algorithm>
#include <limits>

#include "base/assert.h"
#include "string/broad_phase/gap_bounds.h"
#include "string/contact/contact_stage.h"

namespace jawari {
namespace {

/// group_step_push <- what the step's impulses may move each group's gaps until the frame's end [m].
void weigh_pushes(const StringModel& model, StringState& state) {
    const StringShape& shape = *model.shape;
    const ContactState& contact = state.contact;
    const std::size_t groups = group_count(model);
    JAWARI_ASSERT(shape.certificate.push_speed.size() == groups * shape.contact_count);
    double* push = state.certificate.bounds.group_step_push.data();
    std::fill_n(push, groups, 0.0);
    for (const auto c : contact.candidates) {
        const double impulse = contact.impulse[c];
        if (impulse == 0) continue;  // most candidates have none
        const double* push_speed = shape.certificate.push_speed.data() + c * groups;
        for (std::size_t g = 0; g < groups; ++g) push[g] += push_speed[g] * impulse;
    }
    const double time_left = shape.step_s * static_cast<double>(state.steps_left) + lookahead(model);
    const double safety = bound_safety * model.tuning.certificate.push_growth;
    for (std::size_t g = 0; g < groups; ++g) push[g] = safety * push[g] * time_left;
}

/// What all impulses of a frame in contact space may have moved a group's gaps [m].
double push_of_frame(const StringModel& model, const StringState& state, std::size_t g) {
    const NearState& near = state.near_frame;
    const double* push_path = model.tuning.certificate.push_path.data() + g * model.shape->contact_count;
    double path = 0;
    for (const auto c : near.struck) path += push_path[c] * state.contact.frame_impulse[c];
    return bound_safety * path;
}

/// Calls join(c) for the contacts that are not near and have no margin left once push_of_group(g) [m] is
/// charged to it. Returns whether there are any.
template <class Push, class Join>
bool admit(const StringModel& model, StringState& state, const Push& push_of_group, const Join& join) {
    const ContactState& contact = state.contact;
    GapBounds& bounds = state.certificate.bounds;
    bool admitted = false;
    for (std::size_t g = 0; g < group_count(model); ++g) {
        const double push = push_of_group(g);
        if (bounds.group_margin[g] > push) continue;
        double smallest = std::numeric_limits<double>::infinity();
        for (const std::size_t c : contacts_of(model, g)) {
            if (contact.is_near[c] != 0) continue;
            if (bounds.margin[c] > push) {
                smallest = std::min(smallest, bounds.margin[c]);
                continue;
            }
            join(c);
            admitted = true;
        }
        bounds.group_margin[g] = smallest;
    }
    return admitted;
}

}  // namespace

bool admit_pushed_in_step(const StringModel& model, StringState& state) JAWARI_REALTIME {
    if (state.contact.near.size() == model.shape->contact_count) return false;
    weigh_pushes(model, state);
    const GapBounds& bounds = state.certificate.bounds;
    return admit(
        model, state, [&](std::size_t g) { return bounds.group_push[g] + bounds.group_step_push[g]; },
        [&](std::size_t c) { join_step(model, state, c); });
}

void charge_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME {
    state.certificate.validity.outdated = true;
    if (state.contact.near.size() == model.shape->contact_count) return;
    GapBounds& bounds = state.certificate.bounds;
    for (std::size_t g = 0; g < group_count(model); ++g) bounds.group_push[g] += bounds.group_step_push[g];
}

bool admit_pushed_in_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    return admit(
        model, state,
        [&](std::size_t g) {
            return state.certificate.bounds.group_push[g] = push_of_frame(model, state, g);
        },
        [&](std::size_t c) { make_near(contact, c); });
}

}  // namespace jawari
