// One instance as a CLAP host sees it.
#pragma once

#include <clap/ext/gui.h>
#include <clap/ext/params.h>
#include <clap/ext/state.h>
#include <clap/ext/timer-support.h>
#include <clap/plugin.h>

#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <memory>

#include "plugin/clap/extensions.h"
#include "plugin/clap/gui.h"
#include "plugin/core/guarded.h"
#include "plugin/core/plugin_core.h"

namespace jawari::host::clap {

inline constexpr const char* plugin_id = "jawari.jawari";

/// What hosts list. Threads: any.
const clap_plugin_descriptor_t& descriptor();

/// Null where the host has no such extension.
struct HostExtensions {
    const clap_host_params_t* params = nullptr;
    const clap_host_state_t* state = nullptr;
    const HostPresetLoad* preset_load = nullptr;
    const HostLog* log = nullptr;
    const clap_host_gui_t* gui = nullptr;
    const clap_host_timer_support_t* timer = nullptr;
    const HostFiles* files = nullptr;
};

struct Instance {
    clap_plugin_t plugin{};
    const clap_host_t* host = nullptr;
    HostExtensions extensions;
    PluginCore core;
    bool active = false;
    double rate_hz = 48000;
    std::int64_t next_steady_time =
        -1;  ///< of the audio thread: where the next block begins if none is left out
    /// What the window does to parameters, on its way to the host's automation.
    boost::lockfree::spsc_queue<Edit, boost::lockfree::capacity<256>> edits;
    std::unique_ptr<Gui> gui;  ///< while there is a window
};

inline Instance& instance_of(const clap_plugin_t* plugin) {
    return *static_cast<Instance*>(plugin->plugin_data);
}

/// Null if there is not enough memory. The host ends it by destroy().
const clap_plugin_t* create_instance(const clap_host_t* host);

/// Tells the host why something was refused. Threads: the host's main thread.
void log_error_of(const Instance& instance, const Error& error);

/// The host has called back: a window that has asked for it draws.
void take_gui_call(Instance& instance);

/// The host asks for all values again: a state or preset has set them.
void announce_values(const Instance& instance);

// Of the other files of this folder, for Instance's get_extension().
const void* audio_ports_extension();
const void* note_ports_extension();
const void* params_extension();
const void* state_extension();
const void* latency_extension();
const void* tail_extension();
const void* render_extension();
const void* preset_load_extension();
const void* gui_extension();
const void* timer_extension();
const void* files_extension();

/// What entry.cpp offers beside the plugin.
const PresetDiscoveryFactory& discovery_factory();

}  // namespace jawari::host::clap
