// What a host finds in the file.
#include <travesty/factory.h>

#include <cstdio>
#include <cstring>

#include "jawari/version.h"
#include "plugin/vst3/instance.h"
#include "plugin/vst3/text16.h"

namespace jawari::host::vst3 {

namespace {

constexpr std::int32_t texts_are_unicode = 1 << 4;
constexpr std::int32_t many_instances = 0x7FFFFFFF;
constexpr const char* category = "Audio Module Class";
constexpr const char* sub_categories = "Instrument|Synth";
constexpr const char* interface_version = "VST 3.7.4";
constexpr const char* vendor = "Jawari";

template <std::size_t size>
void write(char (&place)[size], const char* text) {
    std::snprintf(place, size, "%s", text);
}

template <std::size_t size>
void write(std::int16_t (&place)[size], const char* text) {
    write_text(text, place, size);
}

extern const v3_plugin_factory_cpp factory_table;

struct Factory {
    const v3_plugin_factory_cpp* table;
};

Factory& factory() {
    static Factory one{&factory_table};
    return one;
}

v3_result query_factory(void* self, const v3_tuid iid, void** object) {
    const bool known = v3_tuid_match(iid, v3_funknown_iid) || v3_tuid_match(iid, v3_plugin_factory_iid) ||
                       v3_tuid_match(iid, v3_plugin_factory_2_iid) ||
                       v3_tuid_match(iid, v3_plugin_factory_3_iid);
    *object = known ? self : nullptr;
    return known ? V3_OK : V3_NO_INTERFACE;
}

/// It lives as long as the file.
std::uint32_t count_nothing(void* /*self*/) {
    return 1;
}

v3_result get_factory_info(void* /*self*/, v3_factory_info* info) {
    *info = {};
    write(info->vendor, vendor);
    info->flags = texts_are_unicode;
    return V3_OK;
}

std::int32_t class_count(void* /*self*/) {
    return 1;
}

/// What all three kinds of descriptions have.
template <class Info>
v3_result describe(std::int32_t index, Info& info) {
    if (index != 0) return V3_INVALID_ARG;
    info = {};
    std::memcpy(info.class_id, class_id, sizeof class_id);
    info.cardinality = many_instances;
    write(info.category, category);
    write(info.name, "Jawari");
    return V3_OK;
}

template <class Info>
v3_result describe_more(std::int32_t index, Info& info) {
    if (const v3_result result = describe(index, info); result != V3_OK) return result;
    write(info.sub_categories, sub_categories);
    write(info.vendor, vendor);
    write(info.version, JAWARI_VERSION);
    write(info.sdk_version, interface_version);
    return V3_OK;
}

v3_result get_class_info(void* /*self*/, std::int32_t index, v3_class_info* info) {
    return describe(index, *info);
}

v3_result get_class_info_2(void* /*self*/, std::int32_t index, v3_class_info_2* info) {
    return describe_more(index, *info);
}

v3_result get_class_info_3(void* /*self*/, std::int32_t index, v3_class_info_3* info) {
    return describe_more(index, *info);
}

v3_result set_host_context(void* /*self*/, v3_funknown** /*host*/) {
    return V3_OK;
}

v3_result create(void* /*self*/, const v3_tuid wanted_class, const v3_tuid iid, void** object) {
    *object = nullptr;
    if (!v3_tuid_match(wanted_class, class_id)) return V3_INVALID_ARG;
    Instance* const instance = create_instance();
    if (instance == nullptr) return V3_NOMEM;
    Interface& first = instance->interfaces[component_interface];
    const v3_result result = query_interface(&first, iid, object);
    release_reference(&first);  // what the host has asked for holds its own
    return result;
}

const v3_plugin_factory_cpp factory_table{{query_factory, count_nothing, count_nothing},
                                          {get_factory_info, class_count, get_class_info, create},
                                          {get_class_info_2},
                                          {get_class_info_3, set_host_context}};

}  // namespace

}  // namespace jawari::host::vst3

#define JAWARI_EXPORT extern "C" __attribute__((visibility("default")))

JAWARI_EXPORT const void* GetPluginFactory();
JAWARI_EXPORT bool ModuleEntry(void* library);
JAWARI_EXPORT bool ModuleExit();

const void* GetPluginFactory() {
    return &jawari::host::vst3::factory();
}

bool ModuleEntry(void* /*library*/) {
    return true;
}

bool ModuleExit() {
    return true;
}
