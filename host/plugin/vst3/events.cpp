#include "plugin/vst3/events.h"

#include <algorithm>
#include <cmath>

#include "plugin/vst3/extensions.h"
#include "plugin/vst3/parameters.h"

namespace jawari::host::vst3 {

namespace {

constexpr double cents_per_semitone = 100;

void take_value(PluginCore& core, const TimedChange& change) {
    if (!std::isfinite(change.value)) return;
    if (const auto parameter = table_parameter(change.which))
        core.set_parameter(*parameter,
                           value_meant(declaration_of(*parameter), change.value, core.value(*parameter)),
                           change.frame);
    else if (const auto message = controller_message(change.which, change.value))
        core.take(*message, change.frame);
}

/// Velocities that come from MIDI are n/127 rounded to a float: they are taken for what they were, so that a
/// note has the same bits in all formats.
double velocity_of(float velocity) {
    constexpr double steps = 127;
    const double step = std::round(static_cast<double>(velocity) * steps) / steps;
    return static_cast<float>(step) == velocity ? step : static_cast<double>(velocity);
}

void take_note_on(PluginCore& core, const v3_event_note_on& note, std::size_t frame) {
    const NoteAddress address{note.note_id, 0, note.channel, note.pitch};
    core.note_on(address, velocity_of(note.velocity), frame);
    if (note.tuning != 0)
        core.express(PluginExpression::Tuning, address, static_cast<double>(note.tuning) / cents_per_semitone,
                     frame);
}

void take_expression(PluginCore& core, const v3_event_note_expression_value& event, std::size_t frame) {
    if (event.note_id < 0) return;
    const NoteAddress which{event.note_id, -1, -1, -1};
    if (event.type_id == tuning_type)
        core.express(PluginExpression::Tuning, which, tuning_semitones(event.value), frame);
    else if (event.type_id == brightness_type)
        core.express(PluginExpression::Brightness, which, event.value, frame);
    else if (event.type_id == volume_type)
        core.express(PluginExpression::Volume, which, volume_factor(event.value), frame);
    else if (event.type_id == pan_type)
        core.express(PluginExpression::Pan, which, event.value, frame);
}

/// What the interface has for MIDI going out; some hosts send it in.
void take_midi(PluginCore& core, const v3_event_legacy_midi_cc_out& event, std::size_t frame) {
    const auto channel = static_cast<std::uint8_t>(static_cast<unsigned>(event.channel) & 0x0FU);
    const auto data = [](std::int8_t value) { return static_cast<std::uint8_t>(std::max<int>(value, 0)); };
    if (event.cc_number < 128)
        core.take({static_cast<std::uint8_t>(0xB0U | channel), event.cc_number, data(event.value)}, frame);
    else if (event.cc_number == channel_pressure_controller)
        core.take({static_cast<std::uint8_t>(0xD0U | channel), data(event.value), 0}, frame);
    else if (event.cc_number == pitch_bend_controller)
        core.take({static_cast<std::uint8_t>(0xE0U | channel), data(event.value), data(event.value2)}, frame);
}

void take_event(PluginCore& core, const v3_event& event, std::size_t frame) {
    if (event.bus_index != 0) return;
    switch (event.type) {
        case V3_EVENT_NOTE_ON:
            take_note_on(core, event.note_on, frame);
            break;
        case V3_EVENT_NOTE_OFF:
            core.note_off({event.note_off.note_id, 0, event.note_off.channel, event.note_off.pitch},
                          velocity_of(event.note_off.velocity), frame);
            break;
        case V3_EVENT_POLY_PRESSURE:
            core.express(
                PluginExpression::Pressure,
                {event.poly_pressure.note_id, -1, event.poly_pressure.channel, event.poly_pressure.pitch},
                velocity_of(event.poly_pressure.pressure), frame);
            break;
        case V3_EVENT_NOTE_EXP_VALUE:
            take_expression(core, event.note_exp_value, frame);
            break;
        case V3_EVENT_LEGACY_MIDI_CC_OUT:
            take_midi(core, event.midi_cc_out, frame);
            break;
        default:
            break;
    }
}

/// Applies what has been gathered. Changes that come after a full gathering are later than they should be:
/// none is lost.
void apply(PluginCore& core, TimedChanges& gathered, v3_event_list** events) {
    for (const TimedChange& change : gathered.sorted()) {
        if (!change.is_event) {
            take_value(core, change);
            continue;
        }
        v3_event event{};
        if (v3_cpp_obj(events)->get_event(events, static_cast<std::int32_t>(change.which), &event) == V3_OK)
            take_event(core, event, change.frame);
    }
    gathered.clear();
}

void gather_values(PluginCore& core, TimedChanges& gathered, const v3_process_data& data) {
    v3_param_changes** const changes = data.input_params;
    if (changes == nullptr) return;
    const std::int32_t parameters = v3_cpp_obj(changes)->get_param_count(changes);
    for (std::int32_t p = 0; p < parameters; ++p) {
        v3_param_value_queue** const queue = v3_cpp_obj(changes)->get_param_data(changes, p);
        if (queue == nullptr) continue;
        const v3_param_id id = v3_cpp_obj(queue)->get_param_id(queue);
        const std::int32_t points = v3_cpp_obj(queue)->get_point_count(queue);
        for (std::int32_t i = 0; i < points; ++i) {
            std::int32_t frame = 0;
            double value = 0;
            if (v3_cpp_obj(queue)->get_point(queue, i, &frame, &value) != V3_OK) continue;
            if (gathered.is_full()) apply(core, gathered, data.input_events);
            gathered.add_value(frame, id, value);
        }
    }
}

void gather_events(PluginCore& core, TimedChanges& gathered, const v3_process_data& data) {
    v3_event_list** const events = data.input_events;
    if (events == nullptr) return;
    const std::uint32_t count = v3_cpp_obj(events)->get_event_count(events);
    for (std::uint32_t i = 0; i < count; ++i) {
        v3_event event{};
        if (v3_cpp_obj(events)->get_event(events, static_cast<std::int32_t>(i), &event) != V3_OK) continue;
        if (gathered.is_full()) apply(core, gathered, events);
        gathered.add_event(event.sample_offset, i);
    }
}

}  // namespace

void take_changes(PluginCore& core, TimedChanges& room, const v3_process_data& data) JAWARI_REALTIME {
    room.clear();
    gather_values(core, room, data);
    gather_events(core, room, data);
    apply(core, room, data.input_events);
}

}  // namespace jawari::host::vst3
