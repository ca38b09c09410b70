#include "plugin/vst3/instance.h"

#include <travesty/audio_processor.h>
#include <travesty/component.h>
#include <travesty/unit.h>

#include <memory>

#include "plugin/vst3/extensions.h"
#include "plugin/vst3/parameters.h"

namespace jawari::host::vst3 {

namespace {

struct InterfaceId {
    const v3_tuid& iid;
    InterfaceIndex index;
};

/// Where each interface is; a base of several is asked of the first.
const InterfaceId* find_interface(const std::uint8_t* iid) {
    static constexpr std::array<InterfaceId, 9> known{{
        {v3_funknown_iid, component_interface},
        {v3_plugin_base_iid, component_interface},
        {v3_component_iid, component_interface},
        {v3_audio_processor_iid, processor_interface},
        {v3_edit_controller_iid, controller_interface},
        {v3_midi_mapping_iid, midi_mapping_interface},
        {v3_unit_information_iid, units_interface},
        {note_expression_iid, note_expression_interface},
        {v3_process_context_requirements_iid, context_requirements_interface},
    }};
    for (const InterfaceId& each : known)
        if (v3_tuid_match(each.iid, iid)) return &each;
    return nullptr;
}

}  // namespace

Instance* create_instance() {
    std::unique_ptr<Instance> made;
    if (!guarded([&] {
            made = std::make_unique<Instance>();
            return true;
        }))
        return nullptr;
    const std::array<const void*, interface_count> tables{
        component_table(), processor_table(),       controller_table(),          midi_mapping_table(),
        units_table(),     note_expression_table(), context_requirements_table()};
    for (std::size_t i = 0; i < tables.size(); ++i) made->interfaces[i] = {tables[i], made.get()};
    announce_values(*made);
    return made.release();
}

v3_result query_interface(void* self, const v3_tuid iid, void** object) {
    const InterfaceId* const found = find_interface(iid);
    *object = nullptr;
    if (found == nullptr) return V3_NO_INTERFACE;
    *object = &instance_of(self).interfaces[found->index];
    add_reference(self);
    return V3_OK;
}

std::uint32_t add_reference(void* self) {
    return instance_of(self).references.fetch_add(1) + 1;
}

std::uint32_t release_reference(void* self) {
    Instance& instance = instance_of(self);
    const std::uint32_t left = instance.references.fetch_sub(1) - 1;
    if (left == 0) delete &instance;  // NOLINT(cppcoreguidelines-owning-memory): the hosts owned it
    return left;
}

namespace {

void keep_context(Instance& instance, v3_funknown** context) {
    if (context != nullptr) v3_cpp_obj_ref(context);
    if (instance.context != nullptr) v3_cpp_obj_unref(instance.context);
    instance.context = context;
}

}  // namespace

v3_result initialize(void* self, v3_funknown** context) {
    keep_context(instance_of(self), context);
    return V3_OK;
}

v3_result terminate(void* self) {
    Instance& instance = instance_of(self);
    if (instance.handler != nullptr) v3_cpp_obj_unref(instance.handler);
    instance.handler = nullptr;
    keep_context(instance, nullptr);
    instance.active = false;
    instance.core.deactivate();
    return V3_OK;
}

void announce_values(Instance& instance) {
    for (const ParameterDeclaration& parameter : parameter_table())
        instance.travels[static_cast<std::size_t>(parameter.id)] =
            parameter_travel(parameter, instance.core.value(parameter.id));
    instance.program = program_of(instance.core.state().preset_text);
    if (instance.handler != nullptr)
        v3_cpp_obj(instance.handler)->restart_component(instance.handler, V3_RESTART_PARAM_VALUES_CHANGED);
}

}  // namespace jawari::host::vst3
