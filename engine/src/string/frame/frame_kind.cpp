#include "string/frame/frame_kind.h"

#include "string/frame/short_frame.h"
#include "string/state/excitation.h"

namespace jawari {
namespace {

bool may_skip(const StringModel& model, const StringState& state) {
    const Skipping& skipping = state.skipping;
    const bool any =
        skipping.flight || skipping.certificate || skipping.near || skipping.lazy || skipping.sleep;
    return any && model.shape->scheme == Scheme::Exact && state.metering != Metering::Step;
}

/// Whether a contact is so likely that testing for it costs more than it saves.
bool expects_contact(const StringState& state) {
    return state.certificate.struck || (is_excited(state) && state.certificate.backoff.left > 0);
}

}  // namespace

bool sleeps_on(const StringState& state) JAWARI_REALTIME {
    return state.asleep && !is_excited(state) && state.contact.moving_count == 0;
}

bool solves_short_frames(const StringModel& model, const StringState& state) JAWARI_REALTIME {
    return evaluates_near_alone(state) && has_short_frames(model);
}

bool steps_uniformly(const StringModel& model, const StringState& state) JAWARI_REALTIME {
    return !may_skip(model, state) || state.contact.moving_count > 0 || model.shape->has_dashpots ||
           (!state.skipping.certificate && model.shape->contact_count > 0);
}

std::optional<FrameKind> choose_frame_kind(const StringModel& model, const StringState& state,
                                           BroadPhaseAnswer answer) JAWARI_REALTIME {
    if (sleeps_on(state)) return FrameKind::Asleep;
    if (steps_uniformly(model, state)) return FrameKind::Uniform;
    if (answer == BroadPhaseAnswer::Planned) return FrameKind::Planned;
    if (answer == BroadPhaseAnswer::Open) return FrameKind::Checked;
    if (solves_short_frames(model, state)) {
        const bool unanswered = answer == BroadPhaseAnswer::NotAsked && !expects_contact(state);
        return unanswered ? std::nullopt : std::optional(FrameKind::Short);
    }
    if (answer != BroadPhaseAnswer::MayClose) return std::nullopt;
    const bool in_contact_space =
        evaluates_near_alone(state) && !model.tuning.response.empty() && !state.near_frame.crowded;
    return in_contact_space ? FrameKind::NearInContactSpace : FrameKind::NearStepped;
}

}  // namespace jawari
