// Forecast: the low modes are advanced exactly into the coming frames, and the displacement of all other
// modes is bounded. The gaps that follow certify contacts several frames ahead (docs/engine/certificate.md,
// section 3).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Returns the number of coming frames, at most `frames`, in which none of forecast.watched can close. Their
/// readings then hold at the end of these frames, when the odometers have moved on by them. If the number is
/// 0, the contacts that cannot close in the coming frame have their margin and are marked by certified_at.
std::size_t forecast_frames(const StringModel& model, StringState& state, std::size_t frames) JAWARI_REALTIME;

/// Tests forecast.watched in the coming frame alone, which has been flown already, forces included. The
/// contacts that may close become certificate.expired.
void forecast_flown_frame(const StringModel& model, StringState& state) JAWARI_REALTIME;

/// After an impulse: the gaps of the low modes at the coming frame's start are unknown.
inline void forget_low_gaps(StringState& state) JAWARI_REALTIME {
    std::vector<std::uint64_t>& known = state.certificate.forecast.gap_at;
    std::fill(known.begin(), known.end(), unknown_frame);
}

}  // namespace jawari
