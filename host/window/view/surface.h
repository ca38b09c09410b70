// The widget of DPF that draws the window and hands it its events.
#pragma once

#include <NanoVG.hpp>
#include <TopLevelWidget.hpp>
#include <functional>

#include "window/model/pacer.h"
#include "window/view/main_view.h"
#include "window/view/x11_display.h"
#include "window/window.h"

namespace jawari::host::window {

class Surface : public DGL_NAMESPACE::TopLevelWidget {
  public:
    /// `foreign_key`: is given what the window does not use.
    Surface(DGL_NAMESPACE::Window& window, MainView& view, double scale,
            std::function<void(const KeyEventFacts&)> foreign_key);
    ~Surface() override;
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;
    Surface(Surface&&) = delete;
    Surface& operator=(Surface&&) = delete;

    /// Asks for a frame if something has changed and it is time.
    void idle(double now_s);
    [[nodiscard]] const WindowCounts& counts() const { return counts_; }

  protected:
    void onDisplay() override;
    void onResize(const ResizeEvent& event) override;
    bool onMouse(const MouseEvent& event) override;
    bool onMotion(const MotionEvent& event) override;
    bool onScroll(const ScrollEvent& event) override;
    bool onKeyboard(const KeyboardEvent& event) override;
    bool onCharacterInput(const CharacterInputEvent& event) override;

  private:
    void draw_still();
    void copy_still();
    void paste_still();
    void draw_moving();
    [[nodiscard]] Pointer pointer_at(double x, double y, unsigned modifiers) const;
    bool use_key(const KeyboardEvent& event);

    MainView& view_;
    DGL_NAMESPACE::NanoVG nanovg_;
    const double scale_;
    std::function<void(const KeyEventFacts&)> foreign_key_;
    Pacer pacer_;
    WindowCounts counts_;
    unsigned texture_ = 0;  ///< what rarely changes, as it was drawn
    unsigned texture_width_ = 0, texture_height_ = 0;
    bool in_software_ = false;  ///< OpenGL draws in threads of the processor
    bool knows_renderer_ = false;
    unsigned button_ = 0;  ///< that is down
};

}  // namespace jawari::host::window
