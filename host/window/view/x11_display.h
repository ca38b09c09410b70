// What is asked of X11 beside what DPF does: whether there is a display on which OpenGL draws, and that keys
// which the window does not use go to its host.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace jawari::host::window {

struct KeyEventFacts {
    bool press = false;
    unsigned keycode = 0;
    bool shift = false, control = false, alt = false;
};

/// A connection of its own.
class X11Display {
  public:
    /// Null, and why: no display, or none with OpenGL.
    static std::unique_ptr<X11Display> open(std::string& trouble);
    ~X11Display();
    X11Display(const X11Display&) = delete;
    X11Display& operator=(const X11Display&) = delete;
    X11Display(X11Display&&) = delete;
    X11Display& operator=(X11Display&&) = delete;

    /// As if it had been pressed there.
    void send_key(std::uintptr_t window, const KeyEventFacts& facts);
    /// The window that has it as its child; 0 for a window of its own.
    void stay_above(std::uintptr_t window, std::uintptr_t owner);

  private:
    explicit X11Display(void* display) : display_(display) {}
    void* display_;
};

}  // namespace jawari::host::window
