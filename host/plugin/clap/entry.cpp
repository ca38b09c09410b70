// What a host finds in the file: the plugin, and where its presets are.
#include <clap/entry.h>
#include <clap/plugin-factory.h>

#include <cstring>

#include "plugin/clap/instance.h"

namespace jawari::host::clap {

namespace {

std::uint32_t plugin_count(const clap_plugin_factory_t* /*factory*/) {
    return 1;
}

const clap_plugin_descriptor_t* plugin_descriptor(const clap_plugin_factory_t* /*factory*/,
                                                  std::uint32_t index) {
    return index == 0 ? &descriptor() : nullptr;
}

const clap_plugin_t* create_plugin(const clap_plugin_factory_t* /*factory*/, const clap_host_t* host,
                                   const char* id) {
    const bool is_ours = id != nullptr && std::strcmp(id, plugin_id) == 0;
    if (!is_ours || host == nullptr || !clap_version_is_compatible(host->clap_version)) return nullptr;
    return create_instance(host);
}

bool init_library(const char* /*path*/) {
    return true;
}

void end_library() {}

const void* get_factory(const char* id) {
    static constexpr clap_plugin_factory_t factory{plugin_count, plugin_descriptor, create_plugin};
    if (id == nullptr) return nullptr;
    if (std::strcmp(id, CLAP_PLUGIN_FACTORY_ID) == 0) return &factory;
    if (std::strcmp(id, discovery_factory_id) == 0 || std::strcmp(id, discovery_factory_draft_id) == 0)
        return &discovery_factory();
    return nullptr;
}

}  // namespace

}  // namespace jawari::host::clap

// Declared by CLAP's header, with C linkage.
const clap_plugin_entry_t clap_entry = {CLAP_VERSION_INIT, jawari::host::clap::init_library,
                                        jawari::host::clap::end_library, jawari::host::clap::get_factory};
