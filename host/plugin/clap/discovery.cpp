// What a host's preset browser can find: the factory presets inside the plugin, and the folders of the
// user's.
#include <clap/plugin-features.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "base/builtin.h"
#include "base/input_file.h"
#include "instrument/preset_library.h"
#include "plugin/clap/instance.h"
#include "plugin/core/preset_facts.h"

namespace jawari::host::clap {

namespace {

constexpr const char* provider_id = "jawari.presets";
constexpr std::size_t longest_preset_bytes = std::size_t{4} << 20U;

struct Provider {
    PresetProvider provider{};
    const PresetIndexer* indexer = nullptr;
    std::vector<PresetFolder> folders;
};

/// False if the host wants no more.
bool tell(const MetadataReceiver& receiver, const PresetFacts& facts, const char* load_key,
          std::uint32_t flags) {
    if (!receiver.begin_preset(&receiver, facts.name.c_str(), load_key)) return false;
    const UniversalPluginId id{"clap", plugin_id};
    receiver.add_plugin_id(&receiver, &id);
    receiver.set_flags(&receiver, flags);
    if (!facts.comment.empty()) receiver.set_description(&receiver, facts.comment.c_str());
    receiver.add_feature(&receiver, CLAP_PLUGIN_FEATURE_INSTRUMENT);
    return true;
}

bool tell_factory(const MetadataReceiver& receiver) {
    for (const BuiltinFile& file : builtin_files("instruments")) {
        const std::string key(file.name);
        const auto facts = preset_facts(file.text, key);
        if (facts && !tell(receiver, *facts, key.c_str(), factory_content)) return true;
    }
    return true;
}

bool tell_file(const MetadataReceiver& receiver, const std::string& path) {
    const auto text = read_file(path, longest_preset_bytes);
    if (!text) {
        receiver.on_error(&receiver, 0, text.error().message.c_str());
        return false;
    }
    const auto facts = preset_facts(text.value(), path);
    if (facts) tell(receiver, *facts, nullptr, user_content);
    return facts.has_value();
}

bool init_provider(const PresetProvider* provider) {
    auto& self = *static_cast<Provider*>(provider->provider_data);
    return guarded([&] {
        const PresetFiletype type{"Jawari preset", "A string instrument", "json"};
        const PresetLocation factory{factory_content, "Factory presets", location_plugin, nullptr};
        if (!self.indexer->declare_filetype(self.indexer, &type)) return false;
        if (!self.indexer->declare_location(self.indexer, &factory)) return false;
        for (const PresetFolder& folder : preset_folders()) {
            if (!path_exists(folder.path)) continue;
            const PresetLocation place{user_content, "Presets", location_file, folder.path.c_str()};
            if (!self.indexer->declare_location(self.indexer, &place)) return false;
        }
        return true;
    });
}

void destroy_provider(const PresetProvider* provider) {
    delete static_cast<Provider*>(provider->provider_data);  // NOLINT(cppcoreguidelines-owning-memory)
}

bool get_metadata(const PresetProvider* /*provider*/, std::uint32_t kind, const char* location,
                  const MetadataReceiver* receiver) {
    return guarded([&] {
        if (kind == location_plugin) return tell_factory(*receiver);
        return kind == location_file && location != nullptr && tell_file(*receiver, location);
    });
}

const void* no_extension(const PresetProvider* /*provider*/, const char* /*id*/) {
    return nullptr;
}

const PresetProviderDescriptor& provider_descriptor() {
    static constexpr PresetProviderDescriptor description{CLAP_VERSION_INIT, provider_id, "Jawari presets",
                                                          "Jawari"};
    return description;
}

std::uint32_t provider_count(const PresetDiscoveryFactory* /*factory*/) {
    return 1;
}

const PresetProviderDescriptor* provider_at(const PresetDiscoveryFactory* /*factory*/, std::uint32_t index) {
    return index == 0 ? &provider_descriptor() : nullptr;
}

const PresetProvider* create_provider(const PresetDiscoveryFactory* /*factory*/, const PresetIndexer* indexer,
                                      const char* id) {
    if (id == nullptr || std::strcmp(id, provider_id) != 0) return nullptr;
    Provider* self = nullptr;
    const bool made = guarded([&] {
        self = new Provider;  // NOLINT(cppcoreguidelines-owning-memory): destroy_provider() ends it
        return true;
    });
    if (!made) return nullptr;
    self->indexer = indexer;
    self->provider = {&provider_descriptor(), self,         init_provider,
                      destroy_provider,       get_metadata, no_extension};
    return &self->provider;
}

}  // namespace

const PresetDiscoveryFactory& discovery_factory() {
    static constexpr PresetDiscoveryFactory factory{provider_count, provider_at, create_provider};
    return factory;
}

}  // namespace jawari::host::clap
