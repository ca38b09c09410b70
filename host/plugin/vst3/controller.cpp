// Parameters as the host's controls show them, and which controllers of MIDI they are.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "base/text.h"
#include "plugin/core/parameter_text.h"
#include "plugin/vst3/instance.h"
#include "plugin/vst3/parameters.h"
#include "plugin/vst3/text16.h"
#include "plugin/vst3/view.h"

namespace jawari::host::vst3 {

namespace {

/// The state of the component is the whole state.
v3_result set_component_state(void* /*self*/, v3_bstream** /*stream*/) {
    return V3_OK;
}

v3_result set_controller_state(void* /*self*/, v3_bstream** /*stream*/) {
    return V3_OK;
}

v3_result get_controller_state(void* /*self*/, v3_bstream** /*stream*/) {
    return V3_OK;
}

std::int32_t get_parameter_count(void* /*self*/) {
    return parameter_total;
}

int last_program() {
    return program_total() - 1;
}

void describe(const ParameterDeclaration& parameter, v3_param_info& info) {
    write_text(parameter.name, info.title);
    write_text(parameter.short_name, info.short_title);
    info.default_normalised_value = parameter_travel(parameter, parameter.neutral);
    info.unit_id = unit_of(parameter.id);
    info.flags = V3_PARAM_CAN_AUTOMATE;
    if (parameter.curve == Curve::Stepped) {
        info.step_count = static_cast<std::int32_t>(parameter.high - parameter.low);
        info.flags |= V3_PARAM_IS_LIST;
    }
}

v3_result get_parameter_info(void* /*self*/, std::int32_t index, v3_param_info* info) {
    if (index < 0 || index >= parameter_total) return V3_INVALID_ARG;
    *info = {};
    info->param_id = parameter_at(index);
    if (const auto parameter = table_parameter(info->param_id)) {
        describe(declaration_of(*parameter), *info);
    } else if (info->param_id == program_parameter) {
        write_text("Preset", info->title);
        write_text("Preset", info->short_title);
        info->step_count = last_program();
        info->flags = V3_PARAM_PROGRAM_CHANGE | V3_PARAM_IS_LIST;
    } else {
        const std::string name = controller_name(info->param_id);
        write_text(name, info->title);
        write_text(name, info->short_title);
        info->flags = V3_PARAM_CAN_AUTOMATE | V3_PARAM_IS_HIDDEN;
    }
    return V3_OK;
}

bool is_share(double value) {
    return value >= 0 && value <= 1;
}

int program_at(double value) {
    return static_cast<int>(std::lround(value * last_program()));
}

double plain_of(v3_param_id id, double value) {
    if (const auto parameter = table_parameter(id)) return parameter_value(declaration_of(*parameter), value);
    if (id == program_parameter) return program_at(value);
    return std::round(127 * value);
}

double share_of(v3_param_id id, double plain) {
    if (const auto parameter = table_parameter(id))
        return parameter_travel(declaration_of(*parameter), plain);
    return std::clamp(plain / (id == program_parameter ? last_program() : 127), 0.0, 1.0);
}

v3_result get_text(void* /*self*/, v3_param_id id, double value, std::int16_t* text) {
    if (!is_share(value)) return V3_INVALID_ARG;
    const bool written = guarded([&] {
        const double plain = plain_of(id, value);
        if (const auto parameter = table_parameter(id))
            write_text(parameter_text(*parameter, plain), text);
        else if (id == program_parameter)
            write_text(programs()[static_cast<std::size_t>(plain)].name, text);
        else if (is_controller(id))
            write_text(std::to_string(static_cast<int>(plain)), text);
        else
            return false;
        return true;
    });
    return written ? V3_OK : V3_INVALID_ARG;
}

std::optional<double> value_of_text(v3_param_id id, const std::string& text) {
    if (const auto parameter = table_parameter(id)) return parameter_from_text(*parameter, text);
    if (id == program_parameter) {
        for (int program = 0; program <= last_program(); ++program)
            if (programs()[static_cast<std::size_t>(program)].name == text) return program;
        return std::nullopt;
    }
    return is_controller(id) ? parse_number(text) : std::nullopt;
}

v3_result get_value_of_text(void* /*self*/, v3_param_id id, std::int16_t* text, double* value) {
    if (text == nullptr) return V3_INVALID_ARG;
    const bool read = guarded([&] {
        const auto plain = value_of_text(id, read_text(text));
        if (!plain || !std::isfinite(*plain)) return false;
        *value = share_of(id, *plain);
        return true;
    });
    return read ? V3_OK : V3_INVALID_ARG;
}

double to_plain(void* /*self*/, v3_param_id id, double value) {
    return plain_of(id, std::clamp(value, 0.0, 1.0));
}

double to_share(void* /*self*/, v3_param_id id, double plain) {
    return share_of(id, plain);
}

double get_value(void* self, v3_param_id id) {
    const Instance& instance = instance_of(self);
    if (table_parameter(id)) return instance.travels[id];
    return id == program_parameter ? share_of(id, instance.program) : 0;
}

/// A program that is there already loads nothing: hosts repeat their choice after a state.
v3_result choose_program(Instance& instance, int program) {
    if (program == instance.program) return V3_OK;
    if (program == 0) {
        instance.program = 0;
        return V3_OK;
    }
    const bool loaded = guarded([&] {
        const BuiltinFile& file = programs()[static_cast<std::size_t>(program)].preset;
        return !instance.core.load_preset(std::string(file.name), std::string(file.text));
    });
    if (!loaded) return V3_INTERNAL_ERR;
    announce_values(instance);
    return V3_OK;
}

v3_result set_value(void* self, v3_param_id id, double value) {
    Instance& instance = instance_of(self);
    if (!is_share(value)) return V3_INVALID_ARG;
    if (const auto parameter = table_parameter(id)) {
        instance.travels[id] = value;
        if (!instance.active)
            instance.core.set_value(
                *parameter, value_meant(declaration_of(*parameter), value, instance.core.value(*parameter)));
        return V3_OK;
    }
    if (id == program_parameter) return choose_program(instance, program_at(value));
    return is_controller(id) ? V3_OK : V3_INVALID_ARG;
}

v3_result set_component_handler(void* self, v3_component_handler** handler) {
    Instance& instance = instance_of(self);
    if (handler != nullptr) v3_cpp_obj_ref(handler);
    if (instance.handler != nullptr) v3_cpp_obj_unref(instance.handler);
    instance.handler = handler;
    return V3_OK;
}

v3_plugin_view** create_view(void* self, const char* name) {
    const bool known = name != nullptr && std::strcmp(name, "editor") == 0;
    return known ? create_plugin_view(instance_of(self)) : nullptr;
}

v3_result get_midi_controller_assignment(void* /*self*/, std::int32_t bus, std::int16_t channel,
                                         std::int16_t controller, v3_param_id* id) {
    const bool known = bus == 0 && channel >= 0 && channel < controller_channels && controller >= 0 &&
                       controller < controllers_per_channel;
    if (!known) return V3_FALSE;
    *id = controller_parameter(channel, controller);
    return V3_OK;
}

}  // namespace

const void* controller_table() {
    static constexpr v3_edit_controller_cpp table{
        unknown_table,
        {initialize, terminate},
        {set_component_state, set_controller_state, get_controller_state, get_parameter_count,
         get_parameter_info, get_text, get_value_of_text, to_plain, to_share, get_value, set_value,
         set_component_handler, create_view}};
    return &table;
}

const void* midi_mapping_table() {
    static constexpr v3_midi_mapping_cpp table{unknown_table, {get_midi_controller_assignment}};
    return &table;
}

}  // namespace jawari::host::vst3
