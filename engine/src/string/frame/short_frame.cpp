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
    const auto count = static_cast<std::ptrdiff_t>(model.contact_count);
    const auto stride = static_cast<std::ptrdiff_t>(model.contact_stride);
    for (auto* array : {&contact.gap, &contact.gap_before})
        std::fill(array->begin() + count, array->begin() + stride, 1.0);
}

}  // namespace

void set_short_frames(StringModel& model) {
    const bool fits = model.contact_count <= contacts_with_own_bounds &&
                      model.contact_stride * model.steps_per_frame <= largest_short_frame;
    if (!fits || model.step_response.empty() || model.law != ImpactLaw::Signorini) return;
    model.contact_columns.assign(model.stride * model.contact_stride, 0.0);
    for (std::size_t c = 0; c < model.contact_count; ++c) {
        for (std::size_t k = 0; k < model.stride; ++k)
            model.contact_columns[k * model.contact_stride + c] = model.contact_rows[c * model.stride + k];
    }
}

bool solve_short_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    JAWARI_ASSERT(has_short_frames(model));
    JAWARI_ASSERT(state.short_frame.rates.size() >= model.steps_per_frame * model.contact_stride);
    ShortFrameState& frame = state.short_frame;
    if (frame.gaps_at != state.frame || state.frame % gap_period == 0) place_all_gaps(model, state);
    bool finite = kernels::run_freely(model, state);
    finite = kernels::solve_steps(model, state) && finite;
    std::vector<double>& open_until = state.certificate.bounds.open_until;  // until note_short_frame()
    std::fill(open_until.begin(), open_until.end(), -std::numeric_limits<double>::infinity());
    const bool struck = !frame.struck.empty();
    if (struck) {
        state.active_modes = model.stride;
        state.certificate.validity.outdated = true;
        forget_low_gaps(state);
        finite = kernels::add_response(model, state) && finite;
    }
    state.certificate.struck = struck;
    frame.gaps_at = state.frame + 1;
    state.excitation.elapsed += model.steps_per_frame;
    state.counters.steps += model.steps_per_frame;
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
    for (std::size_t c = 0; c < model.contact_count; ++c) {
        bounds.frame_gap[c] = state.contact.gap[c];
        state.certificate.validity.frame_gap_at[c] = state.frame;
        bounds.open_until[c] = bounds.group_odometer[group_of(model, c)] + state.contact.gap[c];
    }
}

}  // namespace jawari
