// Presets that a host's browser has found (discovery.cpp), on their way into an instance.
#include <string>

#include "base/builtin.h"
#include "plugin/clap/instance.h"

namespace jawari::host::clap {

namespace {

MaybeError load_from(PluginCore& core, std::uint32_t kind, const char* location, const char* key) {
    if (kind == location_file && location != nullptr) return core.load_file(location);
    const BuiltinFile* const builtin =
        kind == location_plugin && key != nullptr ? find_builtin("instruments", key) : nullptr;
    if (builtin == nullptr) return Error{ErrorKind::File, "no such preset"};
    return core.load_preset(std::string(builtin->name), std::string(builtin->text));
}

bool from_location(const clap_plugin_t* plugin, std::uint32_t kind, const char* location,
                   const char* load_key) {
    Instance& instance = instance_of(plugin);
    const HostPresetLoad* const host = instance.extensions.preset_load;
    return guarded([&] {
        if (const auto error = load_from(instance.core, kind, location, load_key)) {
            if (host != nullptr)
                host->on_error(instance.host, kind, location, load_key, 0, error->message.c_str());
            return false;
        }
        announce_values(instance);
        if (host != nullptr) host->loaded(instance.host, kind, location, load_key);
        if (instance.extensions.state != nullptr) instance.extensions.state->mark_dirty(instance.host);
        return true;
    });
}

}  // namespace

const void* preset_load_extension() {
    static constexpr PluginPresetLoad extension{from_location};
    return &extension;
}

}  // namespace jawari::host::clap
