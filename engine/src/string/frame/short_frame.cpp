#include "string/frame/short_frame.h"

#include <algorithm>
#include <limits>

#include "base/assert.h"
#include "string/broad_phase/forecast.h"
#include "string/broad_phase/gap_bounds.h"
#include "string/broad_phase/gap_certificate.h"
#include "string/contact/contact_stage.h"
#include "string/frame/short_frame_contacts.h"
#include "string/frame/short_frame_modes.h"

namespace jawari {
namespace {

/// Gaps continue from frame to frame. After this many frames they are computed from the modes again, so that
/// rounding does not accumulate.
constexpr std::uint64_t gap_period = 64;

/// Computes contact.gap and gap_before of all contacts at the frame's start.
void place_all_gaps(const StringModel& model, StringState& state) {
    ContactState& contact = state.contact;
    choose_all_contacts(model, state);
    place_gaps(model, state);
    // What lies between the contacts and the padding's end never closes.
    const auto count = static_cast<std::ptrdiff_t>(model.shape->contact_count);
    const auto stride = static_cast<std::ptrdiff_t>(model.shape->contact_stride);
    for (auto* array : {&contact.gap, &contact.gap_before})
        std::fill(array->begin() + count, array->begin() + stride, 1.0);
}

}  // namespace

AlignedVector<double> columns_for_short_frames(const StringModel& model) {
    const StringShape& shape = *model.shape;
    AlignedVector<double> columns;
    const bool fits = shape.contact_count <= contacts_with_own_bounds &&
                      shape.contact_stride * shape.steps_per_frame <= largest_short_frame;
    if (!fits || model.tuning.step_response.empty() || shape.law != ImpactLaw::Signorini) return columns;
    columns.assign(shape.stride * shape.contact_stride, 0.0);
    for (std::size_t c = 0; c < shape.contact_count; ++c) {
        for (std::size_t k = 0; k < shape.stride; ++k)
            columns[k * shape.contact_stride + c] = shape.contact_rows[c * shape.stride + k];
    }
    return columns;
}

bool solve_short_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    JAWARI_ASSERT(has_short_frames(model));
    JAWARI_ASSERT(state.short_frame.rates.size() >=
                  model.shape->steps_per_frame * model.shape->contact_stride);
    ShortFrameState& frame = state.short_frame;
    if (frame.gaps_at != state.frame || state.frame % gap_period == 0) place_all_gaps(model, state);
    bool finite = kernels::run_freely(model, state);
    finite = kernels::solve_steps(model, state) && finite;
    std::vector<double>& open_until = state.certificate.bounds.open_until;  // until note_short_frame()
    std::fill(open_until.begin(), open_until.end(), -std::numeric_limits<double>::infinity());
    const bool struck = !frame.struck.empty();
    if (struck) {
        state.active_modes = model.shape->stride;
        state.certificate.validity.outdated = true;
        forget_low_gaps(state);
        finite = kernels::add_response(model, state) && finite;
    }
    state.certificate.struck = struck;
    frame.gaps_at = state.frame + 1;
    state.excitation.elapsed += model.shape->steps_per_frame;
    state.counters.steps += model.shape->steps_per_frame;
    state.counters.near_frames += 1;
    return finite;
}

void forget_responses(StringState& state) JAWARI_REALTIME {
    std::vector<std::uint8_t>& known = state.short_frame.response_known;
    std::fill(known.begin(), known.end(), std::uint8_t{0});
}

void note_short_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    JAWARI_ASSERT(state.short_frame.gaps_at == state.frame);
    GapBounds& bounds = state.certificate.bounds;
    for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
        bounds.frame_gap[c] = state.contact.gap[c];
        state.certificate.validity.frame_gap_at[c] = state.frame;
        bounds.open_until[c] = bounds.group_odometer[group_of(model, c)] + state.contact.gap[c];
    }
}

}  // namespace jawari
