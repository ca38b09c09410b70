// A window as its host has it. The thread that makes it calls everything.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "window/performance.h"

namespace jawari::host::window {

struct WindowSize {
    unsigned width = 0, height = 0;  ///< in pixels of the screen
    bool operator==(const WindowSize&) const = default;
};

struct WindowRequest {
    std::uintptr_t parent = 0;  ///< X11 window in which it lies; 0: a window of its own
    double scale = 0;           ///< pixels of the screen per unit of the layout; 0: as the system says
    WindowSize size{};          ///< zeros: its own choice
    std::string title = "Jawari";
};

/// What a window has done since it was made.
struct WindowCounts {
    std::uint64_t drawn = 0;  ///< frames
    double drawing_s = 0;     ///< processor time of drawing [s]
};

class Window {
  public:
    Window() = default;
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    Window(Window&&) = delete;
    Window& operator=(Window&&) = delete;
    virtual ~Window() = default;

    /// Takes what came from the user and draws if something has changed and it is time. To be called about
    /// every 10 to 16 ms.
    virtual void idle() = 0;
    virtual void show() = 0;
    /// Nothing is drawn until show().
    virtual void hide() = 0;
    /// The user has closed it.
    [[nodiscard]] virtual bool is_closed() const = 0;
    [[nodiscard]] virtual WindowSize size() const = 0;
    virtual void set_size(const WindowSize& size) = 0;
    /// The nearest size that it can have.
    [[nodiscard]] virtual WindowSize nearest(const WindowSize& size) const = 0;
    virtual void set_title(const std::string& title) = 0;
    /// Of X11.
    [[nodiscard]] virtual std::uintptr_t native() const = 0;
    /// A window of its own stays above that X11 window.
    virtual void stay_above(std::uintptr_t owner) = 0;
    [[nodiscard]] virtual WindowCounts counts() const = 0;
};

}  // namespace jawari::host::window
