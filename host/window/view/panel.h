// A part of the window: draws itself, takes the mouse while a button is down on it, and keys while it has the
// focus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "window/model/layout.h"
#include "window/performance.h"
#include "window/view/canvas.h"

namespace jawari::host::window {

struct Pointer {
    float x = 0, y = 0;
    unsigned button = 0;  ///< 1 left, 2 right, 3 middle; 0: none
    bool shift = false;
    bool twice = false;  ///< a second press soon after the first at the same place
};

enum class KeyName { Left, Right, Up, Down, PageUp, PageDown, Home, End, Enter, Delete, Escape };

struct KeyPress {
    KeyName key = KeyName::Enter;
    bool shift = false;
};

/// What panels share.
struct Shared {
    Shared(Performance& of, Layout first_layout) : performance(of), layout(std::move(first_layout)) {}

    Performance& performance;
    Layout layout;
    const StagePicture* picture = nullptr;  ///< the latest; null before the first
    bool still_changed = true;              ///< what rarely changes is to be drawn again
    bool moving_changed = true;             ///< what moves is to be drawn again
    bool focus_shown = false;               ///< keys are in use: the focus is drawn
    bool setup = false;                     ///< the tab "Setup" is chosen
    bool presets_open = false;              ///< the list lies over the strings
    double now_s = 0;
    std::string hint;  ///< of what is under the pointer

    void say(const std::string& text) {
        if (hint == text) return;
        hint = text;
        still_changed = true;
    }
};

class Panel {
  public:
    explicit Panel(Shared& shared) : shared_(shared) {}
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;
    Panel(Panel&&) = delete;
    Panel& operator=(Panel&&) = delete;
    virtual ~Panel() = default;

    /// The layout, or the preset, is another one.
    virtual void place() {}
    virtual void draw_still(Canvas& /*canvas*/) {}
    virtual void draw_moving(Canvas& /*canvas*/) {}
    /// Called at each idle(); sets Shared::still_changed or moving_changed if there is something new.
    virtual void follow(double /*passed_s*/) {}

    /// True: the pointer was on the panel, which gets drag() and release().
    virtual bool press(const Pointer& /*pointer*/) { return false; }
    virtual void drag(const Pointer& /*pointer*/) {}
    virtual void release(const Pointer& /*pointer*/) {}
    /// True: the pointer is on the panel.
    virtual bool hover(const Pointer& /*pointer*/) { return false; }
    virtual void leave() {}
    virtual bool scroll(const Pointer& /*pointer*/, float /*lines*/) { return false; }

    /// Stops of the Tab key. The focus is at one of them, or elsewhere: no_stop.
    [[nodiscard]] virtual std::size_t stops() const { return 0; }
    static constexpr std::size_t no_stop = static_cast<std::size_t>(-1);
    void set_focus(std::size_t stop) { focus_ = stop; }
    [[nodiscard]] std::size_t focus() const { return focus_; }
    /// True: the key is used.
    virtual bool key(const KeyPress& /*press*/) { return false; }
    virtual bool character(std::uint32_t /*character*/, const char* /*text*/) { return false; }

  protected:
    [[nodiscard]] bool shows_focus(std::size_t stop) const { return shared_.focus_shown && focus_ == stop; }
    static void draw_focus(Canvas& canvas, const Box& box) {
        canvas.frame({box.x - 3, box.y - 3, box.width + 6, box.height + 6}, theme::accent, 1.5F, 4);
    }

    Shared& shared_;

  private:
    std::size_t focus_ = no_stop;
};

}  // namespace jawari::host::window
