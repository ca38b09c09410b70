// Finds the module that draws windows and opens one. The module is loaded when the first window is asked for,
// so that programs and plugins work where there is no OpenGL and no X11.
#pragma once

#include <memory>

#include "base/error.h"
#include "window/window.h"

namespace jawari::host::window {

/// Name of the module's file. It lies beside the file whose code calls load_window(), or in ../lib/jawari
/// from there.
inline constexpr const char* module_file = "jawari-window.so";

/// An error of kind Device, one line, where there is no module, no display or no OpenGL. The module stays
/// loaded: drivers of graphics cards do not survive being unloaded. `performance` outlives the window.
Outcome<std::unique_ptr<Window>> open_window(const WindowRequest& request, Performance& performance);

/// Whether the module's file is there. Nothing is loaded.
bool has_window_module();

/// Why no window can be opened: no module, no display, no OpenGL. Nothing if one can.
MaybeError display_trouble();

/// Entries of the module. True if there is a display; else `trouble` (of `size` bytes) says why there is
/// none.
using FindDisplayFunction = bool (*)(char* trouble, std::size_t size);
inline constexpr const char* find_display_symbol =
    "jawari_find_display_1";  /// On failure null, and `trouble` says why.
using OpenWindowFunction = Window* (*)(const WindowRequest& request, Performance& performance, char* trouble,
                                       std::size_t size);
inline constexpr const char* open_window_symbol = "jawari_open_window_1";

}  // namespace jawari::host::window
