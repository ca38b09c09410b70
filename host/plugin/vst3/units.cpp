// Groups of parameters, and the list of factory presets.
#include <travesty/unit.h>

#include <algorithm>
#include <vector>

#include "plugin/core/parameter_text.h"
#include "plugin/vst3/instance.h"
#include "plugin/vst3/parameters.h"
#include "plugin/vst3/text16.h"

namespace jawari::host::vst3 {

namespace {

constexpr std::int32_t root_unit = 0;
constexpr std::int32_t no_unit = -1;
constexpr std::int32_t no_list = -1;
constexpr std::int32_t preset_list = 1;

std::int32_t get_unit_count(void* /*self*/) {
    return 1 + static_cast<std::int32_t>(parameter_groups().size());
}

v3_result get_unit_info(void* self, std::int32_t index, v3_unit_info* info) {
    if (index < 0 || index >= get_unit_count(self)) return V3_INVALID_ARG;
    info->id = index;
    info->parent_unit_id = index == root_unit ? no_unit : root_unit;
    info->program_list_id = index == root_unit ? preset_list : no_list;
    write_text(index == root_unit ? "Jawari" : parameter_groups()[static_cast<std::size_t>(index - 1)],
               info->name);
    return V3_OK;
}

std::int32_t get_program_list_count(void* /*self*/) {
    return 1;
}

v3_result get_program_list_info(void* /*self*/, std::int32_t index, v3_program_list_info* info) {
    if (index != 0) return V3_INVALID_ARG;
    info->id = preset_list;
    info->programCount = program_total();
    write_text("Factory presets", info->name);
    return V3_OK;
}

v3_result get_program_name(void* /*self*/, std::int32_t list, std::int32_t program, std::int16_t* name) {
    if (list != preset_list || program < 0 || program >= program_total()) return V3_INVALID_ARG;
    write_text(programs()[static_cast<std::size_t>(program)].name, name);
    return V3_OK;
}

v3_result get_program_info(void* /*self*/, std::int32_t /*list*/, std::int32_t /*program*/,
                           const char* /*attribute*/, std::int16_t* /*value*/) {
    return V3_NOT_IMPLEMENTED;
}

v3_result has_program_pitch_names(void* /*self*/, std::int32_t /*list*/, std::int32_t /*program*/) {
    return V3_FALSE;
}

v3_result get_program_pitch_name(void* /*self*/, std::int32_t /*list*/, std::int32_t /*program*/,
                                 std::int16_t /*pitch*/, std::int16_t* /*name*/) {
    return V3_NOT_IMPLEMENTED;
}

std::int32_t get_selected_unit(void* /*self*/) {
    return root_unit;
}

v3_result select_unit(void* self, std::int32_t unit) {
    return unit >= 0 && unit < get_unit_count(self) ? V3_OK : V3_INVALID_ARG;
}

v3_result get_unit_by_bus(void* /*self*/, std::int32_t /*type*/, std::int32_t /*direction*/,
                          std::int32_t /*bus*/, std::int32_t /*channel*/, std::int32_t* unit) {
    *unit = root_unit;
    return V3_OK;
}

v3_result set_unit_program_data(void* /*self*/, std::int32_t /*list*/, std::int32_t /*program*/,
                                v3_bstream** /*data*/) {
    return V3_NOT_IMPLEMENTED;
}

}  // namespace

std::int32_t unit_of(ParameterId parameter) {
    const std::vector<std::string_view>& groups = parameter_groups();
    const auto found = std::find(groups.begin(), groups.end(), declaration_of(parameter).group);
    return 1 + static_cast<std::int32_t>(found - groups.begin());
}

const void* units_table() {
    static constexpr v3_unit_information_cpp table{
        unknown_table,
        {get_unit_count, get_unit_info, get_program_list_count, get_program_list_info, get_program_name,
         get_program_info, has_program_pitch_names, get_program_pitch_name, get_selected_unit, select_unit,
         get_unit_by_bus, set_unit_program_data}};
    return &table;
}

}  // namespace jawari::host::vst3
