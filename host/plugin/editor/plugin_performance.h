// What the window of a plugin instance shows and plays, whatever the format.
#pragma once

#include <deque>
#include <functional>
#include <future>
#include <optional>
#include <string>

#include "plugin/core/plugin_core.h"
#include "window/performance.h"

namespace jawari::host {

/// What the format's adapter tells its host. Each may be empty.
struct EditorHost {
    std::function<void(ParameterId)> begin_edit;
    std::function<void(ParameterId, double)> edit;
    std::function<void(ParameterId)> end_edit;
    std::function<void()> wake;           ///< the instance is to be processed again
    std::function<void()> state_changed;  ///< another preset: values, and the session's state
    /// Of a host that keeps the values itself (ports of LV2), and the instance follows: what it last said.
    /// edit() is all that sets one then.
    std::function<double(ParameterId)> value;
};

/// Threads: the host's main thread. Presets are compiled beside it.
class PluginPerformance : public window::Performance {
  public:
    PluginPerformance(PluginCore& core, EditorHost host);
    ~PluginPerformance() override;
    PluginPerformance(const PluginPerformance&) = delete;
    PluginPerformance& operator=(const PluginPerformance&) = delete;
    PluginPerformance(PluginPerformance&&) = delete;
    PluginPerformance& operator=(PluginPerformance&&) = delete;

    /// Takes over what has been compiled. To be called before each Window::idle().
    void tick();

    // ---- window::Performance
    StageLink& link() override { return core_.link(); }
    void wake() override;
    [[nodiscard]] double value(ParameterId parameter) const override {
        return host_.value ? host_.value(parameter) : core_.value(parameter);
    }
    [[nodiscard]] bool can_edit(ParameterId /*parameter*/) const override { return true; }
    void begin_edit(ParameterId parameter) override;
    void edit(ParameterId parameter, double value) override;
    void end_edit(ParameterId parameter) override;
    [[nodiscard]] const window::PresetInForce& preset() const override { return preset_; }
    void load_preset(const std::string& name) override;
    void edit_preset(const std::string& text) override;
    window::PerformanceFacts facts() override;
    std::optional<std::string> notice() override;

  private:
    /// A preset on its way. `neutral`: parameters as well.
    struct Wish {
        std::string name, text;
        bool neutral = false;
    };
    struct Compiled {
        CompileOrder order;
        Wish wish;
        Outcome<CompiledState> state;
    };

    void begin(Wish wish);
    void take_compiled();
    void tell_neutral_values();
    void follow_preset();

    PluginCore& core_;
    EditorHost host_;
    window::PresetInForce preset_;
    std::future<Compiled> compiling_;
    std::optional<Wish> next_;
    std::deque<std::string> lines_;
};

}  // namespace jawari::host
