// What a VST 3 host calls parameters: those of the one table, the choice of a factory preset, and MIDI's
// controllers, which in VST 3 are hidden parameters.
#pragma once

#include <travesty/base.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/builtin.h"
#include "jawari/parameters.h"
#include "midi/channel_message.h"

namespace jawari::host::vst3 {

// Ids never change: sessions keep them. Those of the table are the numbers of ParameterId.
inline constexpr v3_param_id program_parameter = 1000;
inline constexpr v3_param_id first_controller_parameter = 10000;

inline constexpr int controllers_per_channel = 130;  ///< MIDI's 128, channel pressure, pitch bend
inline constexpr int controller_channels = 16;
inline constexpr int parameter_total =
    static_cast<int>(parameter_count) + 1 + controller_channels * controllers_per_channel;

/// The parameter of the table that an id means. Threads: any; realtime-safe.
std::optional<ParameterId> table_parameter(v3_param_id id);

/// What a host means by `travel`, 0 to 1, while `now` is in force, in the parameter's unit. Hosts keep
/// travels as floats at times and repeat what they were told: that leaves the value, or the neutral one, as
/// it is. Threads: any; realtime-safe.
double value_meant(const ParameterDeclaration& parameter, double travel, double now) noexcept;

/// The id of the `index`-th parameter, 0 to parameter_total - 1. Threads: any.
v3_param_id parameter_at(int index);

/// The channel message of a controller at `value`, 0 to 1; nothing if the id is none. Threads: any;
/// realtime-safe.
std::optional<ChannelMessage> controller_message(v3_param_id id, double value);

/// Threads: any; realtime-safe.
bool is_controller(v3_param_id id);

/// The id of a controller: channel 0 to 15, controller 0 to 129. Threads: any.
v3_param_id controller_parameter(int channel, int controller);

/// What people read: "Channel 3 controller 74". Threads: any.
std::string controller_name(v3_param_id id);

/// What a host may choose.
struct Program {
    std::string name;      ///< for people
    BuiltinFile preset{};  ///< of the program 0: none
};

/// 0 is what else the instance plays, the factory presets follow. Reads the names at the first call; none is
/// compiled. Threads: any.
const std::vector<Program>& programs();

/// programs().size().
inline int program_total() {
    return static_cast<int>(programs().size());
}

/// The program with that text, or 0. Threads: any.
int program_of(std::string_view preset_text);

}  // namespace jawari::host::vst3
