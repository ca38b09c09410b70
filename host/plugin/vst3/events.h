// Events and values of a block of a VST 3 host.
#pragma once

#include <travesty/audio_processor.h>

#include "plugin/core/plugin_core.h"
#include "plugin/vst3/timed_changes.h"

namespace jawari::host::vst3 {

/// All of the block, in the order of their frames; at one frame values come before notes. `room` is for this
/// function's use. Between begin_block() and end_block() of the core.
void take_changes(PluginCore& core, TimedChanges& room, const v3_process_data& data) JAWARI_REALTIME;

}  // namespace jawari::host::vst3
