// Blocks of an LV2 host.
#include <lv2/atom/util.h>

#include <algorithm>
#include <cstring>

#include "plugin/lv2/instance.h"

namespace jawari::host::lv2 {

namespace {

bool is_channel_message(const std::uint8_t* bytes, std::uint32_t size) {
    return size >= 1 && size <= 3 && bytes[0] >= 0x80 && bytes[0] < 0xF0;
}

void take_events(Instance& instance) JAWARI_REALTIME {
    if (instance.ports.events == nullptr) return;
    LV2_ATOM_SEQUENCE_FOREACH(instance.ports.events, event) {
        if (event->body.type != instance.urids.midi_event) continue;
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(event + 1);
        const std::uint32_t size = event->body.size;
        const auto frame = static_cast<std::size_t>(std::max<std::int64_t>(event->time.frames, 0));
        if (is_channel_message(bytes, size))
            instance.core.take(
                {bytes[0], size > 1 ? bytes[1] : std::uint8_t{0}, size > 2 ? bytes[2] : std::uint8_t{0}},
                frame);
    }
}

/// The ports hold what is in force. A value with more digits than a port, from a state, stays as it is.
void follow_ports(Instance& instance) JAWARI_REALTIME {
    for (const ParameterDeclaration& parameter : parameter_table()) {
        const float* const port = instance.ports.parameters[static_cast<std::size_t>(parameter.id)];
        if (port != nullptr && static_cast<float>(instance.core.value(parameter.id)) != *port)
            instance.core.set_parameter(parameter.id, static_cast<double>(*port), 0);
    }
}

/// False if the host has no room for it now.
bool schedule(Instance& instance, Work work) {
    return instance.worker->schedule_work(instance.worker->handle, sizeof work, &work) == LV2_WORKER_SUCCESS;
}

bool take_quality(Instance& instance) {
    return guarded([&] {
        const std::lock_guard lock(instance.control);
        const auto error = instance.core.set_offline(instance.wants_offline.load());
        if (error) log_error_of(instance, *error);
        return !error;
    });
}

/// While a host freewheels no block has a deadline: the model of the offline quality is compiled here, so
/// that the first of them has it. The way back must not wait.
void follow_freewheel(Instance& instance) {
    const bool wanted = instance.ports.freewheel != nullptr && *instance.ports.freewheel > 0.5F;
    if (wanted == instance.freewheels) return;
    instance.wants_offline.store(wanted);
    if (!wanted && instance.worker != nullptr) {
        // Failing that, with the next block.
        if (schedule(instance, Work::FollowFreewheel)) instance.freewheels = wanted;
        return;
    }
    instance.freewheels = wanted;
    take_quality(instance);
}

void write_silence(const Ports& ports, std::uint32_t frames) {
    for (float* const to : ports.main)
        if (to != nullptr) std::fill_n(to, frames, 0.0F);
    for (float* const to : ports.strings)
        if (to != nullptr) std::fill_n(to, frames, 0.0F);
}

/// Tells the host once that the window has changed the state: else it would not ask whether to save it.
void write_notices(Instance& instance) JAWARI_REALTIME {
    LV2_Atom_Sequence* const notices = instance.ports.notices;
    if (notices == nullptr) return;
    struct Notice {
        LV2_Atom_Event event;
        LV2_Atom_Object_Body object;
    };
    const std::uint32_t room = notices->atom.size;  // of the body, as the host says
    notices->atom = {sizeof notices->body, instance.urids.atom_sequence};
    notices->body = {0, 0};
    if (room < sizeof notices->body + sizeof(Notice) || !instance.state_changed.exchange(false)) return;
    Notice notice{};
    notice.event.body = {sizeof notice.object, instance.urids.atom_object};
    notice.object.otype = instance.urids.state_changed;
    std::memcpy(notices + 1, &notice, sizeof notice);
    notices->atom.size += static_cast<std::uint32_t>(sizeof notice);
}

PluginOutput output_of(const Ports& ports) {
    PluginOutput output;
    output.main = ports.main;
    output.strings = ports.strings;
    return output;
}

LV2_Worker_Status work(LV2_Handle handle, LV2_Worker_Respond_Function /*respond*/,
                       LV2_Worker_Respond_Handle /*responder*/, std::uint32_t size, const void* data) {
    Instance& instance = instance_of(handle);
    if (size != sizeof(Work)) return LV2_WORKER_ERR_UNKNOWN;
    if (*static_cast<const Work*>(data) == Work::FollowFreewheel)
        return take_quality(instance) ? LV2_WORKER_SUCCESS : LV2_WORKER_ERR_UNKNOWN;
    const std::lock_guard lock(instance.control);
    instance.core.collect();
    return LV2_WORKER_SUCCESS;
}

LV2_Worker_Status take_response(LV2_Handle /*handle*/, std::uint32_t /*size*/, const void* /*data*/) {
    return LV2_WORKER_SUCCESS;
}

}  // namespace

void run(LV2_Handle handle, std::uint32_t frames) {
    Instance& instance = instance_of(handle);
    write_notices(instance);
    if (!instance.active) {  // it could not be activated: the host's log says why
        write_silence(instance.ports, frames);
        return;
    }
    follow_freewheel(instance);
    instance.core.begin_block(output_of(instance.ports), frames, 0);
    follow_ports(instance);
    take_events(instance);
    const bool has_garbage = instance.core.end_block();
    instance.core.ended_notes();
    if (has_garbage && instance.worker != nullptr) schedule(instance, Work::Collect);
}

const void* worker_interface() {
    static constexpr LV2_Worker_Interface interface { work, take_response, nullptr };
    return &interface;
}

}  // namespace jawari::host::lv2
