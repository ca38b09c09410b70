// Audio and note ports, latency, tail and the mode of rendering.
#include <clap/ext/audio-ports.h>
#include <clap/ext/latency.h>
#include <clap/ext/note-ports.h>

#include <cmath>

#include "base/text.h"
#include "plugin/clap/instance.h"

namespace jawari::host::clap {

namespace {

template <std::size_t size>
void write(char (&place)[size], const char* text) {
    std::snprintf(place, size, "%s", text);
}

std::uint32_t audio_port_count(const clap_plugin_t* /*plugin*/, bool is_input) {
    return is_input ? 0 : 2;
}

bool audio_port(const clap_plugin_t* /*plugin*/, std::uint32_t index, bool is_input,
                clap_audio_port_info_t* info) {
    if (is_input || index > 1) return false;
    *info = {};
    info->id = index;
    info->in_place_pair = CLAP_INVALID_ID;
    info->flags = CLAP_AUDIO_PORT_SUPPORTS_64BITS;
    if (index == 0) {
        write(info->name, "Main");
        info->flags |= CLAP_AUDIO_PORT_IS_MAIN;
        info->channel_count = 2;
        info->port_type = CLAP_PORT_STEREO;
    } else {
        write(info->name, "Strings");
        info->channel_count = plugin_string_channels;
    }
    return true;
}

std::uint32_t note_port_count(const clap_plugin_t* /*plugin*/, bool is_input) {
    return is_input ? 1 : 0;
}

bool note_port(const clap_plugin_t* /*plugin*/, std::uint32_t index, bool is_input,
               clap_note_port_info_t* info) {
    if (!is_input || index > 0) return false;
    *info = {};
    info->supported_dialects = CLAP_NOTE_DIALECT_CLAP | CLAP_NOTE_DIALECT_MIDI | CLAP_NOTE_DIALECT_MIDI_MPE;
    info->preferred_dialect = CLAP_NOTE_DIALECT_CLAP;
    write(info->name, "Notes");
    return true;
}

std::uint32_t latency(const clap_plugin_t* /*plugin*/) {
    return 0;
}

std::uint32_t tail(const clap_plugin_t* plugin) {
    return static_cast<std::uint32_t>(std::ceil(plugin_tail_s * instance_of(plugin).rate_hz));
}

bool needs_real_time(const clap_plugin_t* /*plugin*/) {
    return false;
}

bool set_render_mode(const clap_plugin_t* plugin, std::int32_t mode) {
    Instance& instance = instance_of(plugin);
    return guarded([&] {
        const auto error = instance.core.set_offline(mode == render_offline);
        if (error) log_error_of(instance, *error);
        return !error;
    });
}

}  // namespace

const void* audio_ports_extension() {
    static constexpr clap_plugin_audio_ports_t ports{audio_port_count, audio_port};
    return &ports;
}

const void* note_ports_extension() {
    static constexpr clap_plugin_note_ports_t ports{note_port_count, note_port};
    return &ports;
}

const void* latency_extension() {
    static constexpr clap_plugin_latency_t extension{latency};
    return &extension;
}

const void* tail_extension() {
    static constexpr PluginTail extension{tail};
    return &extension;
}

const void* render_extension() {
    static constexpr PluginRender extension{needs_real_time, set_render_mode};
    return &extension;
}

}  // namespace jawari::host::clap
