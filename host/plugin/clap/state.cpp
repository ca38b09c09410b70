// The state, through streams that may take and give a few bytes at a time.
#include <clap/ext/state.h>

#include <array>
#include <string>

#include "plugin/clap/instance.h"

namespace jawari::host::clap {

namespace {

bool write_all(const clap_ostream_t& stream, std::string_view text) {
    while (!text.empty()) {
        const std::int64_t written = stream.write(&stream, text.data(), text.size());
        if (written <= 0 || static_cast<std::uint64_t>(written) > text.size()) return false;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

/// False if the stream fails or does not end in time.
bool read_all(const clap_istream_t& stream, std::string& text) {
    std::array<char, 4096> part{};
    for (;;) {
        const std::int64_t count = stream.read(&stream, part.data(), part.size());
        if (count == 0) return true;
        if (count < 0 || count > static_cast<std::int64_t>(part.size())) return false;
        text.append(part.data(), static_cast<std::size_t>(count));
        if (text.size() > longest_state_bytes) return false;
    }
}

bool save(const clap_plugin_t* plugin, const clap_ostream_t* stream) {
    return guarded([&] { return write_all(*stream, instance_of(plugin).core.save()); });
}

bool load(const clap_plugin_t* plugin, const clap_istream_t* stream) {
    Instance& instance = instance_of(plugin);
    return guarded([&] {
        std::string text;
        if (!read_all(*stream, text)) return false;
        if (const auto error = instance.core.load(text)) {
            log_error_of(instance, *error);
            return false;
        }
        announce_values(instance);
        return true;
    });
}

}  // namespace

const void* state_extension() {
    static constexpr clap_plugin_state_t extension{save, load};
    return &extension;
}

}  // namespace jawari::host::clap
