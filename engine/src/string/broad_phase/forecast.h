// The far-sighted part of the certificate: the low modes of the coming frames exactly, all others by the
// bound of their displacement (docs/engine/certificate.md, section 3).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Of the `watched` contacts in state.certificate.lookout, how many coming frames, at most `frames`, none of
/// them can close in. Their readings then hold at the end of these frames, when the odometers have moved on
/// by them. If it is none, the contacts that cannot close in the coming frame have their margin, marked by
/// certified_at.
std::size_t look_out(const StringModel& model, StringState& state, std::size_t watched,
                     std::size_t frames) JAWARI_REALTIME;

/// The same for the coming frame alone when it has been flown already, forces included. Returns how many of
/// the watched contacts may close; these are state.certificate.expired.
std::size_t look_at_flown(const StringModel& model, StringState& state, std::size_t watched) JAWARI_REALTIME;

/// The low modes' gaps do not go on into the coming frame: an impulse has acted.
inline void forget_low_gaps(StringState& state) JAWARI_REALTIME {
    std::vector<std::uint64_t>& known = state.certificate.lookout.gap_at;
    std::fill(known.begin(), known.end(), unknown_frame);
}

}  // namespace jawari
