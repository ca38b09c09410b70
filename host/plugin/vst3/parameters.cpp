#include "plugin/vst3/parameters.h"

#include <algorithm>
#include <cmath>

#include "plugin/core/preset_facts.h"
#include "plugin/vst3/extensions.h"

namespace jawari::host::vst3 {

std::optional<ParameterId> table_parameter(v3_param_id id) {
    if (id >= parameter_count) return std::nullopt;
    return static_cast<ParameterId>(id);
}

double value_meant(const ParameterDeclaration& parameter, double travel, double now) noexcept {
    for (const double value : {now, parameter.neutral})
        if (static_cast<float>(parameter_travel(parameter, value)) == static_cast<float>(travel))
            return value;
    return parameter_value(parameter, travel);
}

v3_param_id parameter_at(int index) {
    const int of_table = static_cast<int>(parameter_count);
    if (index < of_table) return static_cast<v3_param_id>(index);
    if (index == of_table) return program_parameter;
    return first_controller_parameter + static_cast<v3_param_id>(index - of_table - 1);
}

bool is_controller(v3_param_id id) {
    return id >= first_controller_parameter &&
           id < first_controller_parameter + v3_param_id{controller_channels * controllers_per_channel};
}

v3_param_id controller_parameter(int channel, int controller) {
    return first_controller_parameter +
           static_cast<v3_param_id>(channel * controllers_per_channel + controller);
}

std::optional<ChannelMessage> controller_message(v3_param_id id, double value) {
    if (!is_controller(id) || !std::isfinite(value)) return std::nullopt;
    const v3_param_id index = id - first_controller_parameter;
    const v3_param_id channel = index / controllers_per_channel;
    const auto controller = static_cast<int>(index % controllers_per_channel);
    const double share = std::clamp(value, 0.0, 1.0);
    const auto status = [channel](unsigned kind) { return static_cast<std::uint8_t>(kind | channel); };
    const auto data = static_cast<std::uint8_t>(std::lround(127 * share));
    if (controller == channel_pressure_controller) return ChannelMessage{status(0xD0), data, 0};
    if (controller == pitch_bend_controller) {
        const auto bend = static_cast<unsigned>(std::lround(16383 * share));
        return ChannelMessage{status(0xE0), static_cast<std::uint8_t>(bend & 0x7FU),
                              static_cast<std::uint8_t>(bend >> 7U)};
    }
    return ChannelMessage{status(0xB0), static_cast<std::uint8_t>(controller), data};
}

std::string controller_name(v3_param_id id) {
    const v3_param_id index = id - first_controller_parameter;
    const auto controller = static_cast<int>(index % controllers_per_channel);
    std::string name = "Channel " + std::to_string(index / controllers_per_channel + 1);
    if (controller == channel_pressure_controller) return name + " pressure";
    if (controller == pitch_bend_controller) return name + " pitch bend";
    return name + " controller " + std::to_string(controller);
}

const std::vector<Program>& programs() {
    static const std::vector<Program> all = [] {
        std::vector<Program> made{{"(as loaded)", {}}};
        for (const BuiltinFile& file : builtin_files("instruments")) {
            const auto facts = preset_facts(file.text, std::string(file.name));
            made.push_back({facts && !facts->name.empty() ? facts->name : std::string(file.name), file});
        }
        return made;
    }();
    return all;
}

int program_of(std::string_view preset_text) {
    const std::vector<Program>& all = programs();
    const auto found = std::find_if(all.begin() + 1, all.end(),
                                    [&](const Program& one) { return one.preset.text == preset_text; });
    return found == all.end() ? 0 : static_cast<int>(found - all.begin());
}

}  // namespace jawari::host::vst3
