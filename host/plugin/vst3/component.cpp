// Buses and state.
#include <travesty/component.h>

#include <string>

#include "plugin/vst3/instance.h"
#include "plugin/vst3/text16.h"

namespace jawari::host::vst3 {

namespace {

constexpr std::int32_t output_buses = 1 + static_cast<std::int32_t>(plugin_string_channels);

v3_result get_controller_class_id(void* /*self*/, v3_tuid /*id*/) {
    return V3_NOT_IMPLEMENTED;  // the component is the controller
}

v3_result set_io_mode(void* /*self*/, std::int32_t /*mode*/) {
    return V3_NOT_IMPLEMENTED;
}

std::int32_t get_bus_count(void* /*self*/, std::int32_t media, std::int32_t direction) {
    if (media == V3_AUDIO) return direction == V3_OUTPUT ? output_buses : 0;
    return media == V3_EVENT && direction == V3_INPUT ? 1 : 0;
}

v3_result get_bus_info(void* self, std::int32_t media, std::int32_t direction, std::int32_t bus,
                       v3_bus_info* info) {
    if (bus < 0 || bus >= get_bus_count(self, media, direction)) return V3_INVALID_ARG;
    *info = {};
    info->media_type = media;
    info->direction = direction;
    info->bus_type = bus == 0 ? V3_MAIN : V3_AUX;
    info->flags = bus == 0 ? V3_DEFAULT_ACTIVE : 0;
    if (media == V3_EVENT) {
        info->channel_count = static_cast<std::int32_t>(midi_channel_count);
        write_text("Notes", info->bus_name);
    } else {
        info->channel_count = bus == 0 ? 2 : 1;
        write_text(bus == 0 ? "Main" : "String " + std::to_string(bus), info->bus_name);
    }
    return V3_OK;
}

v3_result get_routing_info(void* /*self*/, v3_routing_info* /*input*/, v3_routing_info* /*output*/) {
    return V3_NOT_IMPLEMENTED;
}

v3_result activate_bus(void* self, std::int32_t media, std::int32_t direction, std::int32_t bus,
                       v3_bool /*state*/) {
    return bus >= 0 && bus < get_bus_count(self, media, direction) ? V3_OK : V3_INVALID_ARG;
}

v3_result set_active(void* self, v3_bool state) {
    Instance& instance = instance_of(self);
    instance.active = false;
    instance.core.deactivate();
    if (state == 0) return V3_OK;
    instance.active = guarded([&] { return !instance.core.activate(instance.rate_hz); });
    instance.has_processed = false;
    return instance.active ? V3_OK : V3_INTERNAL_ERR;
}

/// False if the stream fails or does not end in time. It may give a few bytes at a time.
bool read_all(v3_bstream** stream, std::string& text) {
    std::array<char, 4096> part{};
    for (;;) {
        std::int32_t count = 0;
        const v3_result result =
            v3_cpp_obj(stream)->read(stream, part.data(), static_cast<std::int32_t>(part.size()), &count);
        if (count < 0 || count > static_cast<std::int32_t>(part.size())) return false;
        if (result != V3_OK || count == 0) return count == 0;  // hosts tell the end either way
        text.append(part.data(), static_cast<std::size_t>(count));
        if (text.size() > longest_state_bytes) return false;
    }
}

bool write_all(v3_bstream** stream, std::string text) {
    for (std::size_t done = 0; done < text.size();) {
        std::int32_t count = 0;
        const auto left = static_cast<std::int32_t>(text.size() - done);
        if (v3_cpp_obj(stream)->write(stream, text.data() + done, left, &count) != V3_OK) return false;
        if (count <= 0 || count > left) return false;
        done += static_cast<std::size_t>(count);
    }
    return true;
}

v3_result set_state(void* self, v3_bstream** stream) {
    Instance& instance = instance_of(self);
    if (stream == nullptr) return V3_INVALID_ARG;
    const bool loaded = guarded([&] {
        std::string text;
        return read_all(stream, text) && !instance.core.load(text);
    });
    if (!loaded) return V3_INVALID_ARG;
    announce_values(instance);
    return V3_OK;
}

v3_result get_state(void* self, v3_bstream** stream) {
    if (stream == nullptr) return V3_INVALID_ARG;
    return guarded([&] { return write_all(stream, instance_of(self).core.save()); }) ? V3_OK
                                                                                     : V3_INTERNAL_ERR;
}

}  // namespace

const void* component_table() {
    static constexpr v3_component_cpp table{
        unknown_table,
        {initialize, terminate},
        {get_controller_class_id, set_io_mode, get_bus_count, get_bus_info, get_routing_info, activate_bus,
         set_active, set_state, get_state}};
    return &table;
}

}  // namespace jawari::host::vst3
