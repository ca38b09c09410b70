// What an LV2 host reads of the plugin before it loads it: texts in Turtle (https://www.w3.org/TR/turtle/).
#pragma once

#include <string>

namespace jawari::host::lv2 {

/// Which plugin and presets the bundle has, and whether a window. Threads: any, as below.
std::string manifest_turtle(bool with_window);
/// The plugin and its ports.
std::string plugin_turtle();
/// What the window asks of the host.
std::string window_turtle();
/// The factory presets: a state each, and all parameters neutral.
std::string presets_turtle();

}  // namespace jawari::host::lv2
