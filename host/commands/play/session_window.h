// The window of a live session (--ui): shows and changes what the control thread has.
#pragma once

#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "base/error.h"
#include "commands/play/session.h"
#include "window/load_window.h"

namespace jawari::host {

/// The control thread calls everything. Presets are compiled beside it.
class SessionWindow : public window::Performance {
  public:
    /// An error of kind Device where there is no display. The session is open and outlives the window.
    static Outcome<std::unique_ptr<SessionWindow>> open(Session& session);
    ~SessionWindow() override;
    SessionWindow(const SessionWindow&) = delete;
    SessionWindow& operator=(const SessionWindow&) = delete;
    SessionWindow(SessionWindow&&) = delete;
    SessionWindow& operator=(SessionWindow&&) = delete;

    /// To be called every 10 ms.
    void tick();
    /// The user has closed it.
    [[nodiscard]] bool is_closed() const { return window_->is_closed(); }
    void tell(const std::string& line);

    // ---- window::Performance
    StageLink& link() override { return session_.link(); }
    void wake() override {}
    [[nodiscard]] double value(ParameterId parameter) const override;
    [[nodiscard]] bool can_edit(ParameterId parameter) const override;
    void begin_edit(ParameterId /*parameter*/) override {}
    void edit(ParameterId parameter, double value) override;
    void end_edit(ParameterId /*parameter*/) override {}
    [[nodiscard]] const window::PresetInForce& preset() const override { return preset_; }
    void load_preset(const std::string& name) override;
    void edit_preset(const std::string& text) override;
    window::PerformanceFacts facts() override;
    std::optional<std::string> notice() override;

  private:
    /// Something to compile: a preset of the library, or a text under the name in force.
    struct Wish {
        std::string name;
        std::optional<std::string> text;
    };
    struct Compiled {
        Wish wish;
        Outcome<SharedInstrument> instrument;
    };

    explicit SessionWindow(Session& session) : session_(session) {}
    void begin(Wish wish);
    void take_compiled();
    void follow_preset();

    Session& session_;
    window::PresetInForce preset_;
    std::future<Compiled> compiling_;
    std::optional<Wish> next_;
    std::deque<std::string> lines_;
    std::unique_ptr<window::Window> window_;
};

}  // namespace jawari::host
