#include "player/statistics.h"

namespace jawari::host {

LiveStatistics take_statistics(LiveMeters& meters) {
    constexpr auto relaxed = std::memory_order_relaxed;
    LiveStatistics now;
    now.blocks = meters.blocks.load(relaxed);
    now.frames = meters.frames.load(relaxed);
    now.load = meters.load.load(relaxed);
    now.mean_load = meters.mean_load.load(relaxed);
    now.worst_load = meters.worst_load.exchange(0, relaxed);
    now.peak_left = meters.peak_left.exchange(0, relaxed);
    now.peak_right = meters.peak_right.exchange(0, relaxed);
    now.late_blocks = meters.late_blocks.load(relaxed);
    now.xruns = meters.xruns.load(relaxed);
    now.messages = meters.messages.load(relaxed);
    now.instruments = meters.instruments.load(relaxed);
    now.held_notes = meters.held_notes.load(relaxed);
    now.voices = meters.voices.load(relaxed);
    now.energy_J = meters.energy_J.load(relaxed);
    now.overload_level = meters.overload_level.load(relaxed);
    now.overload_changes = meters.overload_changes.load(relaxed);
    now.notes = meters.notes.load(relaxed);
    now.ignored_notes = meters.ignored_notes.load(relaxed);
    now.stolen_notes = meters.stolen_notes.load(relaxed);
    now.faded_voices = meters.faded_voices.load(relaxed);
    now.nonfinite_resets = meters.nonfinite_resets.load(relaxed);
    now.limiter_gain = meters.limiter_gain.load(relaxed);
    for (std::size_t controller = 0; controller < now.ignored.controllers.size(); ++controller)
        now.ignored.controllers[controller] = meters.ignored_controllers[controller].load(relaxed);
    now.ignored.data = meters.ignored_data.load(relaxed);
    now.ignored.moved_notes = meters.moved_notes.load(relaxed);
    now.ignored.unplayed_notes = meters.unplayed_notes.load(relaxed);
    return now;
}

}  // namespace jawari::host
