#include "window/view/x11_display.h"

#include <GL/glx.h>
#include <X11/Xlib.h>

#include <array>
#include <cstdlib>

namespace jawari::host::window {

std::unique_ptr<X11Display> X11Display::open(std::string& trouble) {
    Display* const display = XOpenDisplay(nullptr);
    if (display == nullptr) {
        const char* const name = std::getenv("DISPLAY");
        trouble = name == nullptr || *name == '\0' ? "there is no display (DISPLAY is not set)"
                                                   : "the display " + std::string(name) + " cannot be opened";
        return nullptr;
    }
    std::array<int, 10> wanted{
        GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 4, GLX_GREEN_SIZE, 4, GLX_STENCIL_SIZE, 1, None, None};
    int error = 0;
    int event = 0;
    XVisualInfo* const visual = glXQueryExtension(display, &error, &event) == 0
                                    ? nullptr
                                    : glXChooseVisual(display, DefaultScreen(display), wanted.data());
    if (visual == nullptr) {
        trouble = "the display has no OpenGL";
        XCloseDisplay(display);
        return nullptr;
    }
    XFree(visual);
    return std::unique_ptr<X11Display>(new X11Display(display));
}

X11Display::~X11Display() {
    XCloseDisplay(static_cast<Display*>(display_));
}

void X11Display::send_key(std::uintptr_t window, const KeyEventFacts& facts) {
    auto* const display = static_cast<Display*>(display_);
    XEvent event{};
    event.xkey.type = facts.press ? KeyPress : KeyRelease;
    event.xkey.display = display;
    event.xkey.window = window;
    event.xkey.root = DefaultRootWindow(display);
    event.xkey.time = CurrentTime;
    event.xkey.same_screen = True;
    event.xkey.keycode = facts.keycode;
    event.xkey.state = (facts.shift ? static_cast<unsigned>(ShiftMask) : 0U) |
                       (facts.control ? static_cast<unsigned>(ControlMask) : 0U) |
                       (facts.alt ? static_cast<unsigned>(Mod1Mask) : 0U);
    XSendEvent(display, window, True, facts.press ? KeyPressMask : KeyReleaseMask, &event);
    XFlush(display);
}

void X11Display::stay_above(std::uintptr_t window, std::uintptr_t owner) {
    auto* const display = static_cast<Display*>(display_);
    XSetTransientForHint(display, window, owner);
    XFlush(display);
}

}  // namespace jawari::host::window
