// One instance as an LV2 host sees it.
#pragma once

#include <lv2/atom/atom.h>
#include <lv2/core/lv2.h>
#include <lv2/log/log.h>
#include <lv2/state/state.h>
#include <lv2/urid/urid.h>
#include <lv2/worker/worker.h>

#include <array>
#include <atomic>
#include <mutex>

#include "plugin/core/guarded.h"
#include "plugin/core/plugin_core.h"
#include "plugin/lv2/ports.h"

namespace jawari::host::lv2 {

/// Numbers that the host gives to names.
struct Urids {
    LV2_URID atom_chunk = 0;
    LV2_URID atom_string = 0;
    LV2_URID atom_sequence = 0;
    LV2_URID atom_object = 0;
    LV2_URID midi_event = 0;
    LV2_URID log_error = 0;
    LV2_URID state = 0;
    LV2_URID state_changed = 0;
};

/// What is connected; null where nothing is.
struct Ports {
    std::array<float*, 2> main{};
    std::array<float*, plugin_string_channels> strings{};
    const LV2_Atom_Sequence* events = nullptr;
    const float* freewheel = nullptr;
    std::array<const float*, parameter_count> parameters{};
    LV2_Atom_Sequence* notices = nullptr;
};

struct Instance {
    PluginCore core;
    double rate_hz = 48000;
    Urids urids;
    const LV2_Log_Log* log = nullptr;             ///< null: the host keeps none
    const LV2_Worker_Schedule* worker = nullptr;  ///< null: the host has none

    /// Saving, restoring and working may come from several threads.
    std::mutex control;
    /// What the freewheel port says now: work may be late.
    std::atomic<bool> wants_offline{false};
    /// By the window: the host is to be told with the next block.
    std::atomic<bool> state_changed{false};
    bool has_window = false;  ///< guarded by `control`

    // Of the thread that runs it:
    Ports ports;
    bool active = false;
    bool freewheels = false;  ///< as last handed on
};

/// What run() has another thread do.
enum class Work : std::uint32_t { Collect, FollowFreewheel };

inline Instance& instance_of(LV2_Handle handle) {
    return *static_cast<Instance*>(handle);
}

/// What the host offers under that name; null: it does not.
void* find_feature(const LV2_Feature* const* features, const char* uri);

/// Tells the host why something was refused. Threads: not the one that runs the instance.
void log_error_of(const Instance& instance, const Error& error);

/// LV2_Descriptor::run.
void run(LV2_Handle handle, std::uint32_t frames);

// Of the other files of this folder: extensions.
const void* state_interface();
const void* worker_interface();

}  // namespace jawari::host::lv2
