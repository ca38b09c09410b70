// Closes windows as a window manager does for the user. The file that includes it has Xlib before it.
#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>

namespace jawari::test {

inline void close_by_user(::Window window) {
    Display* const display = XOpenDisplay(nullptr);
    XEvent close{};
    close.xclient.type = ClientMessage;
    close.xclient.window = window;
    close.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", 0);
    close.xclient.format = 32;
    close.xclient.data.l[0] = static_cast<long>(XInternAtom(display, "WM_DELETE_WINDOW", 0));
    XSendEvent(display, window, 0, NoEventMask, &close);
    XCloseDisplay(display);
}

/// By its title.
inline void close_by_user(const std::string& title) {
    std::FILE* const found = popen(("xdotool search --name '" + title + "'").c_str(), "r");
    unsigned long window = 0;
    const int count = std::fscanf(found, "%lu", &window);
    pclose(found);
    if (count != 1) throw std::runtime_error("no window is called " + title);
    close_by_user(window);
}

}  // namespace jawari::test
