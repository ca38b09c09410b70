// Rungs: an instrument compiled at several qualities, between which each string changes while it sounds. For
// hosts that must not be late: fewer modes and contact steps cost less.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "jawari/instrument/description.h"
#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"
#include "jawari/result.h"

namespace jawari {

/// Adds the instrument's strings at lower qualities to its model, which `instrument` was compiled to. States
/// are to be made afterwards. Fails where compile_instrument() would; a quality at which strings have other
/// contacts is refused.
std::optional<Failure> add_rungs(InstrumentModel& model, const InstrumentDescription& instrument,
                                 std::span<const QualityDescription> lower);

/// String s goes on at another rung, 0 to model.lower.size(): shape and true velocity of the modes that both
/// have stay as they are, modes that only one has are left out or start at rest. The difference in energy is
/// metered (PlayerWork::rungs_J). Between blocks.
void change_rung(const InstrumentModel& model, InstrumentState& state, std::size_t s,
                 std::size_t rung) JAWARI_REALTIME;

/// Fades the motion that was released longest ago, of all strings, within fade_s. False if there is none.
bool fade_oldest_released(InstrumentState& state) JAWARI_REALTIME;

}  // namespace jawari
