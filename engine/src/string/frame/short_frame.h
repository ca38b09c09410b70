// Short frames: few steps over few contacts. All contacts are evaluated side by side, which costs less than a
// broad phase.
#pragma once

#include <cstdint>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Most contacts (padded) times steps of a short frame.
inline constexpr std::size_t largest_short_frame = 256;

/// Whether the model's frames can be solved as short ones.
inline bool has_short_frames(const StringModel& model) {
    return !model.shape->contact_columns.empty();
}

/// StringShape::contact_columns of a model with all its other tables: S^T where frames are short, else empty.
AlignedVector<double> columns_for_short_frames(const StringModel& model);

/// Solves the coming frame from the state at its start: displacement_flown, velocity_flown <- its end,
/// certificate.struck <- whether impulses happened. Returns false if the state is not finite. Precondition:
/// has_short_frames(model).
bool solve_short_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// Forgets the responses that were found at the string's old tension.
void forget_responses(StringState& state) JAWARI_REALTIME;

/// Hands the gaps that the last short frame has computed on to the broad phase. Precondition:
/// short_frame.gaps_at == state.frame.
void note_short_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

}  // namespace jawari
