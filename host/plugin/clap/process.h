// Blocks and events of a CLAP host.
#pragma once

#include <clap/process.h>

#include "plugin/clap/instance.h"

namespace jawari::host::clap {

/// clap_plugin_t::process. Threads: the audio thread.
clap_process_status process_block(const clap_plugin_t* plugin, const clap_process_t* process);

/// What the events say, in their order. Between begin_block() and end_block() of the core.
void take_events(PluginCore& core, const clap_input_events_t* events);

struct Instance;

/// Tells the host what the window has done to parameters.
void report_edits(Instance& instance, const clap_output_events_t* events);

}  // namespace jawari::host::clap
