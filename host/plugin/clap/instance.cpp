#include "plugin/clap/instance.h"

#include <clap/ext/audio-ports.h>
#include <clap/ext/latency.h>
#include <clap/ext/note-ports.h>
#include <clap/plugin-features.h>

#include <array>
#include <cstring>
#include <new>
#include <string>

#include "jawari/version.h"
#include "plugin/clap/process.h"

namespace jawari::host::clap {

namespace {

bool init(const clap_plugin_t* plugin) {
    Instance& instance = instance_of(plugin);
    const clap_host_t* const host = instance.host;
    if (host->get_extension == nullptr) return true;
    const auto ask = [host](const char* id) { return host->get_extension(host, id); };
    instance.extensions.params = static_cast<const clap_host_params_t*>(ask(CLAP_EXT_PARAMS));
    instance.extensions.state = static_cast<const clap_host_state_t*>(ask(CLAP_EXT_STATE));
    instance.extensions.log = static_cast<const HostLog*>(ask(log_id));
    instance.extensions.gui = static_cast<const clap_host_gui_t*>(ask(CLAP_EXT_GUI));
    instance.extensions.timer = static_cast<const clap_host_timer_support_t*>(ask(CLAP_EXT_TIMER_SUPPORT));
    instance.extensions.files = static_cast<const HostFiles*>(ask(files_id));
    const void* load = ask(preset_load_id);
    if (load == nullptr) load = ask(preset_load_draft_id);
    instance.extensions.preset_load = static_cast<const HostPresetLoad*>(load);
    return true;
}

void destroy(const clap_plugin_t* plugin) {
    delete &instance_of(plugin);  // NOLINT(cppcoreguidelines-owning-memory): the host owns it by its address
}

bool activate(const clap_plugin_t* plugin, double rate_hz, std::uint32_t /*fewest*/, std::uint32_t /*most*/) {
    Instance& instance = instance_of(plugin);
    return guarded([&] {
        if (const auto error = instance.core.activate(rate_hz)) {
            log_error_of(instance, *error);
            return false;
        }
        instance.active = true;
        instance.rate_hz = rate_hz;
        instance.next_steady_time = -1;
        return true;
    });
}

void deactivate(const clap_plugin_t* plugin) {
    Instance& instance = instance_of(plugin);
    instance.active = false;
    instance.core.deactivate();
}

bool start_processing(const clap_plugin_t* plugin) {
    return instance_of(plugin).active;
}

void stop_processing(const clap_plugin_t* /*plugin*/) {}

void reset(const clap_plugin_t* plugin) {
    Instance& instance = instance_of(plugin);
    if (!instance.active) return;
    instance.core.reset();
    instance.next_steady_time = -1;
}

void on_main_thread(const clap_plugin_t* plugin) {
    Instance& instance = instance_of(plugin);
    instance.core.collect();
    take_gui_call(instance);
}

struct Extension {
    const char* id;
    const void* (*get)();
};

const void* get_extension(const clap_plugin_t* /*plugin*/, const char* id) {
    static constexpr std::array<Extension, 12> extensions{{
        {CLAP_EXT_AUDIO_PORTS, audio_ports_extension},
        {CLAP_EXT_NOTE_PORTS, note_ports_extension},
        {CLAP_EXT_PARAMS, params_extension},
        {CLAP_EXT_STATE, state_extension},
        {CLAP_EXT_LATENCY, latency_extension},
        {tail_id, tail_extension},
        {render_id, render_extension},
        {preset_load_id, preset_load_extension},
        {preset_load_draft_id, preset_load_extension},
        {CLAP_EXT_GUI, gui_extension},
        {CLAP_EXT_TIMER_SUPPORT, timer_extension},
        {files_id, files_extension},
    }};
    for (const Extension& each : extensions)
        if (id != nullptr && std::strcmp(each.id, id) == 0) return each.get();
    return nullptr;
}

}  // namespace

const clap_plugin_descriptor_t& descriptor() {
    static const char* features[] = {CLAP_PLUGIN_FEATURE_INSTRUMENT, CLAP_PLUGIN_FEATURE_SYNTHESIZER,
                                     CLAP_PLUGIN_FEATURE_STEREO, nullptr};
    static const clap_plugin_descriptor_t description{CLAP_VERSION_INIT,
                                                      plugin_id,
                                                      "Jawari",
                                                      "Jawari",
                                                      "",
                                                      "",
                                                      "",
                                                      JAWARI_VERSION,
                                                      "Strings that strike frets, necks, bridges and threads",
                                                      features};
    return description;
}

const clap_plugin_t* create_instance(const clap_host_t* host) {
    Instance* instance = nullptr;
    const bool made = guarded([&] {
        instance = new Instance;  // NOLINT(cppcoreguidelines-owning-memory): destroy() ends it
        return true;
    });
    if (!made) return nullptr;
    instance->host = host;
    instance->plugin = {
        &descriptor(),    instance,        init,  destroy,       activate,      deactivate,
        start_processing, stop_processing, reset, process_block, get_extension, on_main_thread};
    return &instance->plugin;
}

void log_error_of(const Instance& instance, const Error& error) {
    if (instance.extensions.log != nullptr && instance.extensions.log->log != nullptr)
        instance.extensions.log->log(instance.host, log_error, error.message.c_str());
}

void announce_values(const Instance& instance) {
    if (instance.extensions.params != nullptr)
        instance.extensions.params->rescan(instance.host, CLAP_PARAM_RESCAN_VALUES);
}

}  // namespace jawari::host::clap
