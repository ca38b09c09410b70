// From a voice's modes to the signals of pickups and the force on the bridge.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "jawari/detail/string_state.h"
#include "jawari/instrument/model.h"
#include "jawari/realtime.h"
#include "jawari/scene/reading.h"

namespace jawari {

/// Fills pickup_rows, bridge_row and their values at rest.
void set_output_rows(StoppedStringModel& stopped, const InstrumentDescription& instrument,
                     double output_rate_hz);

/// Most output frames that a voice advances in one go.
inline constexpr std::size_t longest_voice_run = 32;
/// Velocity and displacement under each pickup, and the bridge.
inline constexpr std::size_t most_output_rows = 2 * limits::pickups + 1;

/// What the outputs read of a string, and what they have read at the frames of a run. Only the first `count`
/// rows are set, and only those of their values that frames have been read for.
struct OutputReadings {  // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::size_t count = 0;
    std::array<Reading, most_output_rows> rows;
    std::array<std::array<double, longest_voice_run>, most_output_rows> values;

    [[nodiscard]] std::span<const Reading> span() const { return {rows.data(), count}; }
};

/// OutputReadings::count of a voice.
std::size_t output_rows(const InstrumentModel& model) JAWARI_REALTIME;

/// Sets the rows: those of the pickups in their order, velocity before displacement, then the bridge's.
void set_output_readings(const InstrumentModel& model, const StoppedStringModel& stopped,
                         OutputReadings& readings) JAWARI_REALTIME;

/// Reads the string as it is, as frame n of the run.
void read_outputs(const StringState& string, std::size_t n, const OutputReadings& readings) JAWARI_REALTIME;

/// Sum of the pickups at frame n, in the instrument's unit; `mix`: ParameterId::PickupMix.
double pickup_signal(const InstrumentModel& model, const StoppedStringModel& stopped,
                     const OutputReadings& readings, std::size_t n, double mix) JAWARI_REALTIME;

/// Force on the bridge at frame n beyond the one at rest [N]; of instruments with a body.
double bridge_force(const StoppedStringModel& stopped, const OutputReadings& readings,
                    std::size_t n) JAWARI_REALTIME;

}  // namespace jawari
