// What a host finds in the file, and the life of an instance.
#include <lv2/midi/midi.h>

#include <cstring>
#include <memory>

#include "plugin/lv2/instance.h"

namespace jawari::host::lv2 {

namespace {

LV2_Handle instantiate(const LV2_Descriptor* /*descriptor*/, double rate_hz, const char* /*bundle*/,
                       const LV2_Feature* const* features) {
    const auto* const map = static_cast<const LV2_URID_Map*>(find_feature(features, LV2_URID__map));
    if (map == nullptr) return nullptr;
    std::unique_ptr<Instance> made;
    const bool done = guarded([&] {
        made = std::make_unique<Instance>();
        return true;
    });
    if (!done) return nullptr;
    const auto number = [map](const char* uri) { return map->map(map->handle, uri); };
    made->urids = {number(LV2_ATOM__Chunk),  number(LV2_ATOM__String),       number(LV2_ATOM__Sequence),
                   number(LV2_ATOM__Object), number(LV2_MIDI__MidiEvent),    number(LV2_LOG__Error),
                   number(state_uri),        number(LV2_STATE__StateChanged)};
    made->rate_hz = rate_hz;
    made->core.expect_rate(rate_hz);
    made->log = static_cast<const LV2_Log_Log*>(find_feature(features, LV2_LOG__log));
    made->worker = static_cast<const LV2_Worker_Schedule*>(find_feature(features, LV2_WORKER__schedule));
    return made.release();
}

void connect_port(LV2_Handle handle, std::uint32_t port, void* place) {
    Ports& ports = instance_of(handle).ports;
    if (port < first_string_port)
        ports.main[port - first_main_port] = static_cast<float*>(place);
    else if (port < events_port)
        ports.strings[port - first_string_port] = static_cast<float*>(place);
    else if (port == events_port)
        ports.events = static_cast<const LV2_Atom_Sequence*>(place);
    else if (port == freewheel_port)
        ports.freewheel = static_cast<const float*>(place);
    else if (port == notify_port)
        ports.notices = static_cast<LV2_Atom_Sequence*>(place);
    else if (port < notify_port)
        ports.parameters[port - first_parameter_port] = static_cast<const float*>(place);
}

void activate(LV2_Handle handle) {
    Instance& instance = instance_of(handle);
    instance.active = guarded([&] {
        const std::lock_guard lock(instance.control);
        const auto error = instance.core.activate(instance.rate_hz);
        if (error) log_error_of(instance, *error);
        return !error;
    });
}

void deactivate(LV2_Handle handle) {
    Instance& instance = instance_of(handle);
    const std::lock_guard lock(instance.control);
    instance.active = false;
    instance.core.deactivate();
}

void cleanup(LV2_Handle handle) {
    delete &instance_of(handle);  // NOLINT(cppcoreguidelines-owning-memory): the host owned it by its address
}

const void* extension_data(const char* uri) {
    if (std::strcmp(uri, LV2_STATE__interface) == 0) return state_interface();
    if (std::strcmp(uri, LV2_WORKER__interface) == 0) return worker_interface();
    return nullptr;
}

}  // namespace

void* find_feature(const LV2_Feature* const* features, const char* uri) {
    for (; features != nullptr && *features != nullptr; ++features)
        if (std::strcmp((*features)->URI, uri) == 0) return (*features)->data;
    return nullptr;
}

void log_error_of(const Instance& instance, const Error& error) {
    if (instance.log != nullptr)
        instance.log->printf(instance.log->handle, instance.urids.log_error, "jawari: %s\n",
                             error.message.c_str());
}

}  // namespace jawari::host::lv2

LV2_SYMBOL_EXPORT const LV2_Descriptor* lv2_descriptor(std::uint32_t index) {
    namespace lv2 = jawari::host::lv2;
    static constexpr LV2_Descriptor descriptor{lv2::plugin_uri, lv2::instantiate,   lv2::connect_port,
                                               lv2::activate,   lv2::run,           lv2::deactivate,
                                               lv2::cleanup,    lv2::extension_data};
    return index == 0 ? &descriptor : nullptr;
}
