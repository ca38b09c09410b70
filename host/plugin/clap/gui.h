// The window of an instance as a CLAP host has it.
#pragma once

#include <clap/plugin.h>

#include <cstdint>
#include <memory>

#include "plugin/clap/pulse.h"
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

struct Instance;

/// What has the window redrawn, in the host's main thread: a timer of the host's; where it has none, a file
/// that it waits for; where it waits for none, calls that are asked for in a thread of the window's own.
class GuiClock {
  public:
    explicit GuiClock(const Instance& instance);
    ~GuiClock();
    GuiClock(const GuiClock&) = delete;
    GuiClock& operator=(const GuiClock&) = delete;
    GuiClock(GuiClock&&) = delete;
    GuiClock& operator=(GuiClock&&) = delete;

    [[nodiscard]] bool is_timer(clap_id timer) const { return timer_ != CLAP_INVALID_ID && timer == timer_; }
    /// It has been read if so.
    [[nodiscard]] bool is_file(int file) const;
    [[nodiscard]] bool is_thread() const { return pulse_ != nullptr; }
    /// The call that was asked for has come.
    void answer();

  private:
    const Instance& instance_;
    clap_id timer_ = CLAP_INVALID_ID;
    int file_ = -1;
    std::unique_ptr<Pulse> pulse_;
};

/// From gui.create() to gui.destroy().
struct Gui {
    std::unique_ptr<PluginPerformance> performance;
    std::unique_ptr<window::Window> window;  ///< once there is a parent, or at once if it floats
    window::WindowRequest request;
    bool floats = false;
    bool told_closed = false;
    std::unique_ptr<GuiClock> clock;  ///< while there is a window
};

}  // namespace jawari::host::clap
