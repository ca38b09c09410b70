#include "plugin/clap/process.h"

#include <algorithm>
#include <optional>

namespace jawari::host::clap {

namespace {

/// Null if the event is shorter than its type.
template <class Event>
const Event* as(const clap_event_header_t& header) {
    return header.size >= sizeof(Event) ? reinterpret_cast<const Event*>(&header) : nullptr;
}

NoteAddress address_of(const clap_event_note_t& event) {
    return {event.note_id, event.port_index, event.channel, event.key};
}

void take_note(PluginCore& core, const clap_event_note_t& event) {
    const std::size_t frame = event.header.time;
    switch (event.header.type) {
        case CLAP_EVENT_NOTE_ON:
            core.note_on(address_of(event), event.velocity, frame);
            break;
        case CLAP_EVENT_NOTE_OFF:
            core.note_off(address_of(event), event.velocity, frame);
            break;
        default:
            core.choke(address_of(event), frame);
            break;
    }
}

std::optional<PluginExpression> expression_of(clap_note_expression expression) {
    switch (expression) {
        case CLAP_NOTE_EXPRESSION_TUNING:
            return PluginExpression::Tuning;
        case CLAP_NOTE_EXPRESSION_PRESSURE:
            return PluginExpression::Pressure;
        case CLAP_NOTE_EXPRESSION_BRIGHTNESS:
            return PluginExpression::Brightness;
        case CLAP_NOTE_EXPRESSION_VOLUME:
            return PluginExpression::Volume;
        case CLAP_NOTE_EXPRESSION_PAN:
            return PluginExpression::Pan;
        default:
            return std::nullopt;
    }
}

void take_expression(PluginCore& core, const clap_event_note_expression_t& event) {
    const NoteAddress which{event.note_id, event.port_index, event.channel, event.key};
    if (const auto expression = expression_of(event.expression_id))
        core.express(*expression, which, event.value, event.header.time);
}

/// For all notes; a value for some of them was never offered.
void take_parameter(PluginCore& core, const clap_event_param_value_t& event) {
    const bool for_all = event.note_id < 0 && event.channel < 0 && event.key < 0;
    if (!for_all || event.param_id >= parameter_count) return;
    core.set_parameter(static_cast<ParameterId>(event.param_id), event.value, event.header.time);
}

void take_midi(PluginCore& core, const clap_event_midi_t& event) {
    const bool is_channel_message = event.data[0] >= 0x80 && event.data[0] < 0xF0;
    if (event.port_index == 0 && is_channel_message)
        core.take({event.data[0], event.data[1], event.data[2]}, event.header.time);
}

void take_event(PluginCore& core, const clap_event_header_t& header) {
    if (header.space_id != CLAP_CORE_EVENT_SPACE_ID) return;
    switch (header.type) {
        case CLAP_EVENT_NOTE_ON:
        case CLAP_EVENT_NOTE_OFF:
        case CLAP_EVENT_NOTE_CHOKE:
            if (const auto* event = as<clap_event_note_t>(header)) take_note(core, *event);
            break;
        case CLAP_EVENT_NOTE_EXPRESSION:
            if (const auto* event = as<clap_event_note_expression_t>(header)) take_expression(core, *event);
            break;
        case CLAP_EVENT_PARAM_VALUE:
            if (const auto* event = as<clap_event_param_value_t>(header)) take_parameter(core, *event);
            break;
        case CLAP_EVENT_MIDI:
            if (const auto* event = as<clap_event_midi_t>(header)) take_midi(core, *event);
            break;
        default:
            break;
    }
}

/// Channels of the host's buffer; null where it has none.
template <class Sample, std::size_t count>
void take_channels(Sample* const* from, std::uint32_t channels, std::array<Sample*, count>& to) {
    if (from == nullptr) return;
    for (std::size_t c = 0; c < std::min<std::size_t>(channels, count); ++c) to[c] = from[c];
}

PluginOutput output_of(const clap_process_t& process) {
    PluginOutput output;
    if (process.audio_outputs == nullptr) return output;
    if (process.audio_outputs_count > 0) {
        const clap_audio_buffer_t& main = process.audio_outputs[0];
        take_channels(main.data32, main.channel_count, output.main);
        take_channels(main.data64, main.channel_count, output.main_64);
    }
    if (process.audio_outputs_count > 1) {
        const clap_audio_buffer_t& strings = process.audio_outputs[1];
        take_channels(strings.data32, strings.channel_count, output.strings);
        take_channels(strings.data64, strings.channel_count, output.strings_64);
    }
    return output;
}

/// A host that lets an instance sleep says by its clock how long.
std::uint64_t skipped_frames(Instance& instance, const clap_process_t& process) {
    const std::int64_t expected = instance.next_steady_time;
    const std::int64_t now = process.steady_time;
    instance.next_steady_time = now < 0 ? -1 : now + process.frames_count;
    return expected >= 0 && now > expected ? static_cast<std::uint64_t>(now - expected) : 0;
}

void report_ended_notes(PluginCore& core, const clap_process_t& process) {
    const std::uint32_t last = process.frames_count == 0 ? 0 : process.frames_count - 1;
    for (const NoteAddress& note : core.ended_notes()) {
        if (process.out_events == nullptr) continue;
        const clap_event_note_t event{
            {sizeof(clap_event_note_t), last, CLAP_CORE_EVENT_SPACE_ID, CLAP_EVENT_NOTE_END, 0},
            note.note_id,
            static_cast<std::int16_t>(note.port),
            static_cast<std::int16_t>(note.channel),
            static_cast<std::int16_t>(note.key),
            0};
        process.out_events->try_push(process.out_events, &event.header);
    }
}

}  // namespace

void take_events(PluginCore& core, const clap_input_events_t* events) {
    if (events == nullptr) return;
    const std::uint32_t count = events->size(events);
    for (std::uint32_t i = 0; i < count; ++i)
        if (const clap_event_header_t* const header = events->get(events, i)) take_event(core, *header);
}

void report_edits(Instance& instance, const clap_output_events_t* events) {
    Edit edit;
    while (instance.edits.pop(edit)) {
        if (events == nullptr) continue;
        const auto id = static_cast<clap_id>(edit.parameter);
        if (edit.kind == Edit::Kind::Value) {
            const clap_event_param_value_t event{
                {sizeof event, 0, CLAP_CORE_EVENT_SPACE_ID, CLAP_EVENT_PARAM_VALUE, CLAP_EVENT_IS_LIVE},
                id,
                nullptr,
                -1,
                -1,
                -1,
                -1,
                edit.value};
            events->try_push(events, &event.header);
            continue;
        }
        const std::uint16_t type =
            edit.kind == Edit::Kind::Begin ? CLAP_EVENT_PARAM_GESTURE_BEGIN : CLAP_EVENT_PARAM_GESTURE_END;
        const clap_event_param_gesture_t event{
            {sizeof event, 0, CLAP_CORE_EVENT_SPACE_ID, type, CLAP_EVENT_IS_LIVE}, id};
        events->try_push(events, &event.header);
    }
}

clap_process_status process_block(const clap_plugin_t* plugin, const clap_process_t* process) {
    Instance& instance = instance_of(plugin);
    if (!instance.active) return CLAP_PROCESS_ERROR;
    PluginCore& core = instance.core;
    core.begin_block(output_of(*process), process->frames_count, skipped_frames(instance, *process));
    take_events(core, process->in_events);
    if (core.end_block()) instance.host->request_callback(instance.host);
    report_ended_notes(core, *process);
    report_edits(instance, process->out_events);
    return core.rests() ? CLAP_PROCESS_SLEEP : CLAP_PROCESS_CONTINUE;
}

}  // namespace jawari::host::clap
