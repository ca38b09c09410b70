// Parts of CLAP 1.2 that the headers of dpf-source (CLAP 1.1) do not declare: names and layouts of the
// interface (https://github.com/free-audio/clap), as this adapter uses them.
#pragma once

#include <clap/plugin.h>

#include <cstdint>

namespace jawari::host::clap {

// ---- clap.log: what the host shows of a plugin's troubles

inline constexpr const char* log_id = "clap.log";
inline constexpr std::int32_t log_error = 3;

/// Of the host. Threads: any.
struct HostLog {
    void(CLAP_ABI* log)(const clap_host_t* host, std::int32_t severity, const char* message);
};

// ---- clap.posix-fd-support: files that the host waits for

inline constexpr const char* files_id = "clap.posix-fd-support";
inline constexpr std::uint32_t file_can_be_read = 1;

/// Of the host. Threads: the main thread.
struct HostFiles {
    bool(CLAP_ABI* register_file)(const clap_host_t* host, int file, std::uint32_t wanted);
    bool(CLAP_ABI* modify_file)(const clap_host_t* host, int file, std::uint32_t wanted);
    bool(CLAP_ABI* unregister_file)(const clap_host_t* host, int file);
};

struct PluginFiles {
    void(CLAP_ABI* on_file)(const clap_plugin_t* plugin, int file, std::uint32_t found);
};

// ---- clap.tail

inline constexpr const char* tail_id = "clap.tail";

struct PluginTail {
    std::uint32_t(CLAP_ABI* get)(const clap_plugin_t* plugin);  ///< frames; from INT32_MAX on: for ever
};

// ---- clap.render

inline constexpr const char* render_id = "clap.render";
inline constexpr std::int32_t render_offline = 1;  ///< 0: in real time

struct PluginRender {
    bool(CLAP_ABI* has_hard_realtime_requirement)(const clap_plugin_t* plugin);
    bool(CLAP_ABI* set)(const clap_plugin_t* plugin, std::int32_t mode);
};

// ---- clap.preset-load and the discovery of presets

inline constexpr const char* preset_load_id = "clap.preset-load/2";
inline constexpr const char* preset_load_draft_id = "clap.preset-load.draft/2";

/// Where a preset lies.
inline constexpr std::uint32_t location_file = 0;
inline constexpr std::uint32_t location_plugin = 1;  ///< inside the plugin; its location is null

struct PluginPresetLoad {
    bool(CLAP_ABI* from_location)(const clap_plugin_t* plugin, std::uint32_t kind, const char* location,
                                  const char* load_key);
};

/// Of the host.
struct HostPresetLoad {
    void(CLAP_ABI* on_error)(const clap_host_t* host, std::uint32_t kind, const char* location,
                             const char* load_key, std::int32_t system_error, const char* message);
    void(CLAP_ABI* loaded)(const clap_host_t* host, std::uint32_t kind, const char* location,
                           const char* load_key);
};

inline constexpr const char* discovery_factory_id = "clap.preset-discovery-factory/2";
inline constexpr const char* discovery_factory_draft_id = "clap.preset-discovery-factory/draft-2";

inline constexpr std::uint32_t factory_content = 1U << 0U;
inline constexpr std::uint32_t user_content = 1U << 1U;

/// A plugin in any format.
struct UniversalPluginId {
    const char* abi;
    const char* id;
};

/// Of the host: takes what a file says about its presets.
struct MetadataReceiver {
    void* receiver_data;
    void(CLAP_ABI* on_error)(const MetadataReceiver* receiver, std::int32_t system_error,
                             const char* message);
    bool(CLAP_ABI* begin_preset)(const MetadataReceiver* receiver, const char* name, const char* load_key);
    void(CLAP_ABI* add_plugin_id)(const MetadataReceiver* receiver, const UniversalPluginId* plugin);
    void(CLAP_ABI* set_soundpack_id)(const MetadataReceiver* receiver, const char* id);
    void(CLAP_ABI* set_flags)(const MetadataReceiver* receiver, std::uint32_t flags);
    void(CLAP_ABI* add_creator)(const MetadataReceiver* receiver, const char* creator);
    void(CLAP_ABI* set_description)(const MetadataReceiver* receiver, const char* description);
    void(CLAP_ABI* set_timestamps)(const MetadataReceiver* receiver, std::uint64_t created,
                                   std::uint64_t modified);
    void(CLAP_ABI* add_feature)(const MetadataReceiver* receiver, const char* feature);
    void(CLAP_ABI* add_extra_info)(const MetadataReceiver* receiver, const char* key, const char* value);
};

struct PresetFiletype {
    const char* name;
    const char* description;
    const char* file_extension;  ///< without its dot
};

struct PresetLocation {
    std::uint32_t flags;
    const char* name;
    std::uint32_t kind;
    const char* location;
};

struct PresetSoundpack;  ///< there are none here

/// Of the host: takes where presets lie.
struct PresetIndexer {
    clap_version_t clap_version;
    const char* name;
    const char* vendor;
    const char* url;
    const char* version;
    void* indexer_data;
    bool(CLAP_ABI* declare_filetype)(const PresetIndexer* indexer, const PresetFiletype* filetype);
    bool(CLAP_ABI* declare_location)(const PresetIndexer* indexer, const PresetLocation* location);
    bool(CLAP_ABI* declare_soundpack)(const PresetIndexer* indexer, const PresetSoundpack* soundpack);
    const void*(CLAP_ABI* get_extension)(const PresetIndexer* indexer, const char* id);
};

struct PresetProviderDescriptor {
    clap_version_t clap_version;
    const char* id;
    const char* name;
    const char* vendor;
};

struct PresetProvider {
    const PresetProviderDescriptor* descriptor;
    void* provider_data;
    bool(CLAP_ABI* init)(const PresetProvider* provider);
    void(CLAP_ABI* destroy)(const PresetProvider* provider);
    bool(CLAP_ABI* get_metadata)(const PresetProvider* provider, std::uint32_t kind, const char* location,
                                 const MetadataReceiver* receiver);
    const void*(CLAP_ABI* get_extension)(const PresetProvider* provider, const char* id);
};

struct PresetDiscoveryFactory {
    std::uint32_t(CLAP_ABI* count)(const PresetDiscoveryFactory* factory);
    const PresetProviderDescriptor*(CLAP_ABI* get_descriptor)(const PresetDiscoveryFactory* factory,
                                                              std::uint32_t index);
    const PresetProvider*(CLAP_ABI* create)(const PresetDiscoveryFactory* factory,
                                            const PresetIndexer* indexer, const char* id);
};

}  // namespace jawari::host::clap
