// Frames of few steps over few contacts: everything is evaluated, all contacts side by side, which costs less
// than finding out what need not be.
#pragma once

#include <cstdint>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Rates of at most so many contacts (padded) times steps.
inline constexpr std::size_t largest_short_frame = 256;

/// Whether frames of the model are short.
inline bool has_short_frames(const StringModel& model) {
    return !model.shape->contact_columns.empty();
}

/// StringShape::contact_columns of a model with all its other tables: S^T where frames are short, else empty.
AlignedVector<double> columns_for_short_frames(const StringModel& model);

/// The coming frame, from the state at its start: displacement_flown, velocity_flown <- its end,
/// certificate.struck <- whether impulses happened. Returns false if the state is not finite.
bool solve_short_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// The string's tension has changed: responses that were found at the old one no longer hold.
void forget_responses(StringState& state) JAWARI_REALTIME;

/// What the last short frame knows of all gaps goes to the certificate, for frames that follow.
void note_short_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
