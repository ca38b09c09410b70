// Quality levels of one instrument. A string can switch level while it sounds, so that a real-time host can
// lower the load (fewer modes, fewer contact steps).
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

/// Compiles the strings of `instrument`, which `model` was compiled from, at further qualities and adds them
/// to the model as quality levels 1, 2, ... in the order of `lower`. Make states after this call. Fails
/// where compile_instrument() would, and if a string has other contacts at one of the qualities; the model
/// then keeps the levels added before. Threads: no other thread may use the model meanwhile. Allocates.
std::optional<Failure> add_qualities(InstrumentModel& model, const InstrumentDescription& instrument,
                                     std::span<const QualityDescription> lower);

/// Switches string `string` (index) to quality level `level`, 0 (full) to model.lower.size(); a level beyond
/// changes nothing. Modes that both levels have keep their shape and true velocity; modes that only one has
/// are left out or start at rest. PlayerWork::quality_changes_J meters the difference in energy. Call it
/// between blocks. Threads: one at a time per state; realtime-safe.
void change_quality(const InstrumentModel& model, InstrumentState& state, std::size_t string,
                    std::size_t level) JAWARI_REALTIME;

/// Quality level of string `string` (index): 0 is full quality. Threads: one at a time per state;
/// realtime-safe.
std::size_t quality_level(const InstrumentState& state, std::size_t string) JAWARI_REALTIME;

/// Fades the voice that was released longest ago, of all strings, within fade_s. Returns false if no
/// released voice sounds. Threads: one at a time per state; realtime-safe.
bool fade_oldest_released(InstrumentState& state) JAWARI_REALTIME;

}  // namespace jawari
