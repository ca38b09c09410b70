#include "string/broad_phase/pushed_contacts.h"

#include <algorithm>
#include <limits>

#include "string/broad_phase/gap_bounds.h"
#include "string/contact/contact_stage.h"

namespace jawari {
namespace {

/// What the step's impulses may move a group's gaps until the frame's end [m].
double push_of_step(const StringModel& model, const StringState& state, std::size_t g) {
    const StringShape& shape = *model.shape;
    const ContactState& contact = state.contact;
    const double* push_speed = shape.certificate.push_speed.data() + g * shape.contact_count;
    double speed = 0;
    for (std::size_t i = 0; i < contact.candidate_count; ++i) {
        const auto c = contact.candidates[i];
        speed += push_speed[c] * contact.impulse[c];
    }
    const double time_left = shape.step_s * static_cast<double>(state.steps_left) + lookahead(model);
    return bound_safety * model.tuning.certificate.push_growth * speed * time_left;
}

/// What all impulses of a frame in contact space may have moved a group's gaps [m].
double push_of_frame(const StringModel& model, const StringState& state, std::size_t g) {
    const NearState& near = state.near_frame;
    const double* push_path = model.tuning.certificate.push_path.data() + g * model.shape->contact_count;
    double path = 0;
    for (std::size_t i = 0; i < near.struck_count; ++i) {
        const auto c = near.struck[i];
        path += push_path[c] * state.contact.frame_impulse[c];
    }
    return bound_safety * path;
}

/// Calls join(c) for the contacts that are not near and have no margin left once push_of_group(g) [m] is
/// charged to it. Returns whether there are any.
template <class Push, class Join>
bool admit(const StringModel& model, StringState& state, const Push& push_of_group, const Join& join) {
    const ContactState& contact = state.contact;
    CertificateState& bounds = state.certificate;
    const std::vector<std::size_t>& begin = model.shape->certificate.group_begin;
    bool admitted = false;
    for (std::size_t g = 0; g + 1 < begin.size(); ++g) {
        const double push = push_of_group(g);
        if (bounds.group_margin[g] > push) continue;
        double smallest = std::numeric_limits<double>::infinity();
        for (std::size_t c = begin[g]; c < begin[g + 1]; ++c) {
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
    if (state.contact.near_count == model.shape->contact_count) return false;
    return admit(
        model, state,
        [&](std::size_t g) { return state.certificate.group_push[g] + push_of_step(model, state, g); },
        [&](std::size_t c) { join_step(model, state, c); });
}

void charge_impulses(const StringModel& model, StringState& state) JAWARI_REALTIME {
    CertificateState& bounds = state.certificate;
    bounds.outdated = true;
    if (state.contact.near_count == model.shape->contact_count) return;
    for (std::size_t g = 0; g < group_count(model); ++g)
        bounds.group_push[g] += push_of_step(model, state, g);
}

bool admit_pushed_in_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    ContactState& contact = state.contact;
    return admit(
        model, state,
        [&](std::size_t g) { return state.certificate.group_push[g] = push_of_frame(model, state, g); },
        [&](std::size_t c) {
            contact.near[contact.near_count++] = static_cast<std::uint32_t>(c);
            contact.is_near[c] = 1;
        });
}

}  // namespace jawari
