// The window of an instance as a CLAP host has it.
#pragma once

#include <clap/plugin.h>

#include <cstdint>
#include <memory>

#include "plugin/editor/plugin_performance.h"
#include "window/load_window.h"

namespace jawari::host::clap {

/// What the window does to a parameter.
struct Edit {
    enum class Kind : std::uint8_t { Begin, Value, End };
    Kind kind = Kind::Value;
    ParameterId parameter{};
    double value = 0;  ///< of Kind::Value, in the parameter's unit
};

/// From gui.create() to gui.destroy().
struct Gui {
    std::unique_ptr<PluginPerformance> performance;
    std::unique_ptr<window::Window> window;  ///< once there is a parent, or at once if it floats
    window::WindowRequest request;
    bool floats = false;
    bool told_closed = false;
    clap_id timer = CLAP_INVALID_ID;
};

}  // namespace jawari::host::clap
