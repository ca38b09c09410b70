// The ports of the LV2 plugin, and its names. Sessions keep both: they never change; new ports come at the
// end.
#pragma once

#include <cstddef>
#include <cstdint>

#include "jawari/parameters.h"
#include "plugin/core/plugin_core.h"

namespace jawari::host::lv2 {

inline constexpr const char* plugin_uri = "urn:jawari:instrument";
inline constexpr const char* window_uri = "urn:jawari:instrument#window";
inline constexpr const char* state_uri = "urn:jawari:instrument#state";  ///< the state's one property

inline constexpr std::uint32_t first_main_port = 0;    ///< left, right
inline constexpr std::uint32_t first_string_port = 2;  ///< plugin_string_channels of them
inline constexpr std::uint32_t events_port = first_string_port + plugin_string_channels;
inline constexpr std::uint32_t freewheel_port = events_port + 1;
inline constexpr std::uint32_t first_parameter_port = freewheel_port + 1;
inline constexpr std::uint32_t notify_port = first_parameter_port + parameter_count;  ///< to the host
inline constexpr std::uint32_t port_count = notify_port + 1;

}  // namespace jawari::host::lv2
