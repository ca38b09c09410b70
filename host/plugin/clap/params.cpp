// The parameters, from the one table. Their ids are the numbers of ParameterId, which never change.
#include <clap/ext/params.h>

#include <cstdio>
#include <string>

#include "plugin/clap/instance.h"
#include "plugin/clap/process.h"
#include "plugin/core/parameter_text.h"

namespace jawari::host::clap {

namespace {

std::uint32_t param_count(const clap_plugin_t* /*plugin*/) {
    return parameter_count;
}

void write_text(char* place, std::size_t size, std::string_view text) {
    if (size > 0) std::snprintf(place, size, "%.*s", static_cast<int>(text.size()), text.data());
}

bool param_info(const clap_plugin_t* /*plugin*/, std::uint32_t index, clap_param_info_t* info) {
    if (index >= parameter_count) return false;
    const ParameterDeclaration& parameter = parameter_table()[index];
    *info = {};
    info->id = static_cast<clap_id>(parameter.id);
    info->flags = CLAP_PARAM_IS_AUTOMATABLE;
    if (parameter.curve == Curve::Stepped) info->flags |= CLAP_PARAM_IS_STEPPED;
    write_text(info->name, sizeof info->name, parameter.name);
    write_text(info->module, sizeof info->module, parameter.group);
    info->min_value = parameter.low;
    info->max_value = parameter.high;
    info->default_value = parameter.neutral;
    return true;
}

bool param_value(const clap_plugin_t* plugin, clap_id id, double* value) {
    if (id >= parameter_count) return false;
    *value = instance_of(plugin).core.value(static_cast<ParameterId>(id));
    return true;
}

bool value_to_text(const clap_plugin_t* /*plugin*/, clap_id id, double value, char* text,
                   std::uint32_t size) {
    if (id >= parameter_count) return false;
    return guarded([&] {
        write_text(text, size, parameter_text(static_cast<ParameterId>(id), value));
        return true;
    });
}

bool text_to_value(const clap_plugin_t* /*plugin*/, clap_id id, const char* text, double* value) {
    if (id >= parameter_count || text == nullptr) return false;
    return guarded([&] {
        const auto read = parameter_from_text(static_cast<ParameterId>(id), text);
        if (read) *value = *read;
        return read.has_value();
    });
}

/// While inactive there is no sound that a frame could mean: values alone are taken.
void set_inactive(PluginCore& core, const clap_input_events_t& events) {
    const std::uint32_t count = events.size(&events);
    for (std::uint32_t i = 0; i < count; ++i) {
        const clap_event_header_t* const header = events.get(&events, i);
        const bool is_value = header != nullptr && header->space_id == CLAP_CORE_EVENT_SPACE_ID &&
                              header->type == CLAP_EVENT_PARAM_VALUE &&
                              header->size >= sizeof(clap_event_param_value_t);
        if (!is_value) continue;
        const auto& event = *reinterpret_cast<const clap_event_param_value_t*>(header);
        if (event.param_id < parameter_count)
            core.set_value(static_cast<ParameterId>(event.param_id), event.value);
    }
}

void flush(const clap_plugin_t* plugin, const clap_input_events_t* in, const clap_output_events_t* out) {
    Instance& instance = instance_of(plugin);
    report_edits(instance, out);
    if (in == nullptr) return;
    if (!instance.active) {
        set_inactive(instance.core, *in);
        return;
    }
    instance.core.begin_block({}, 0, 0);
    take_events(instance.core, in);
    if (instance.core.end_block()) instance.host->request_callback(instance.host);
}

}  // namespace

const void* params_extension() {
    static constexpr clap_plugin_params_t extension{param_count,   param_info,    param_value,
                                                    value_to_text, text_to_value, flush};
    return &extension;
}

}  // namespace jawari::host::clap
