// One instance as a VST 3 host sees it: component, processor and edit controller are one object.
#pragma once

#include <travesty/edit_controller.h>

#include <array>
#include <atomic>
#include <cstdint>

#include "plugin/core/guarded.h"
#include "plugin/core/plugin_core.h"
#include "plugin/vst3/timed_changes.h"

namespace jawari::host::vst3 {

inline constexpr v3_tuid class_id = V3_ID(0x4A617761, 0x72695374, 0x72696E67, 0x456E6731);

struct Instance;

/// What a host holds of an instance: it calls the functions of the table with this as their `self`.
struct Interface {
    const void* table = nullptr;
    Instance* instance = nullptr;
};

enum InterfaceIndex : std::size_t {
    component_interface,
    processor_interface,
    controller_interface,
    midi_mapping_interface,
    units_interface,
    note_expression_interface,
    context_requirements_interface,
    interface_count
};

struct Instance {
    std::array<Interface, interface_count> interfaces;
    std::atomic<std::uint32_t> references{1};
    PluginCore core;

    // Of the host's main thread:
    double rate_hz = 48000;
    bool active = false;
    v3_component_handler** handler = nullptr;
    v3_funknown** context = nullptr;  ///< the host itself, between initialize and terminate
    /// What the controls show, 0 to 1. While active the core follows the values in the blocks alone: those
    /// here come from another thread and may be older.
    std::array<double, parameter_count> travels{};
    int program = 0;

    // Of the audio thread:
    bool has_processed = false;  ///< since the last reset
    TimedChanges changes;
};

inline Instance& instance_of(void* self) {
    return *static_cast<Interface*>(self)->instance;
}

/// Null if there is not enough memory. Its one reference is the caller's.
Instance* create_instance();

/// FUnknown, of all interfaces.
v3_result query_interface(void* self, const v3_tuid iid, void** object);
std::uint32_t add_reference(void* self);
std::uint32_t release_reference(void* self);
inline constexpr v3_funknown unknown_table{query_interface, add_reference, release_reference};

/// IPluginBase, of component and controller.
v3_result initialize(void* self, v3_funknown** context);
v3_result terminate(void* self);

/// The controls show what is in force, and the host asks for all values again: a state or preset has set
/// them.
void announce_values(Instance& instance);

// Of the other files of this folder: tables of functions.
const void* component_table();
const void* processor_table();
const void* controller_table();
const void* midi_mapping_table();
const void* units_table();
const void* note_expression_table();
const void* context_requirements_table();

/// Of units.cpp: where a parameter is filed.
std::int32_t unit_of(ParameterId parameter);

}  // namespace jawari::host::vst3
