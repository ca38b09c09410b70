#include "jawari/instrument/expected_notes.h"

#include <algorithm>
#include <array>

#include "base/assert.h"
#include "instrument/play/course_choice.h"

namespace jawari {
namespace {

/// Pedals as the events before have left them.
using Pedals = std::array<bool, midi_channels>;

// What events do to held notes, as far as that decides which courses later ones take.

void let_go(InstrumentState& state, const InstrumentEvent& event, const Pedals& pedals) {
    const std::size_t course = course_holding(state, event.channel, event.key);
    if (course == no_course) return;
    HeldNote& held = state.courses[course].held;
    held.key_down = false;
    held.active = pedals[static_cast<std::size_t>(event.channel)];
}

void move_pedal(InstrumentState& state, const InstrumentEvent& event, Pedals& pedals) {
    const bool down = event.value >= 0.5;
    pedals[static_cast<std::size_t>(event.channel)] = down;
    for (CourseState& course : state.courses) {
        if (!down && !course.held.key_down && course.held.channel == event.channel)
            course.held.active = false;
    }
}

std::size_t take_course(const InstrumentModel& model, InstrumentState& state, const InstrumentEvent& event,
                        std::uint64_t order) {
    std::size_t course = no_course;
    if (event.string < 0 && plays_legato(state, event.channel))
        course = course_to_continue(model, state, event.channel, event.key);
    if (course == no_course) course = choose_course(model, state, event);
    if (course == no_course) return no_course;
    HeldNote& held = state.courses[course].held;
    held.active = true;
    held.key_down = true;
    held.channel = event.channel;
    held.key = event.key;
    held.order = order;
    return course;
}

bool is_note(const InstrumentEvent& event) {
    return (event.type == InstrumentEventType::NoteOn || event.type == InstrumentEventType::NoteOff) &&
           event.key >= 0 && event.key <= 127 && event.value >= 0 && event.value <= 1;
}

bool begins(const InstrumentEvent& event) {
    return event.type == InstrumentEventType::NoteOn && event.value > 0;
}

/// Notes on the way to the caller.
struct Notes {
    std::span<ExpectedNote> room;
    std::size_t count = 0;

    void add(std::size_t string, std::size_t fret) {
        if (count < room.size()) room[count++] = {string, fret};
    }
};

/// One for each string of the course that has the stop.
void add_course(const InstrumentModel& model, std::size_t course, int key, Notes& notes) {
    const std::size_t fret = fret_of(model, course, key);
    for (const std::size_t s : model.courses[course].strings) {
        const auto& stopped = model.strings[s].stopped;
        if (fret < stopped.size() && stopped[fret].key >= 0) notes.add(s, fret);
    }
}

}  // namespace

std::size_t expected_notes(const InstrumentModel& model, InstrumentState& state,
                           std::span<const InstrumentEvent> events,
                           std::span<ExpectedNote> notes) JAWARI_REALTIME {
    JAWARI_ASSERT(state.courses.size() <= limits::instrument_strings);
    std::array<HeldNote, limits::instrument_strings> before;
    for (std::size_t c = 0; c < state.courses.size(); ++c) before[c] = state.courses[c].held;
    Pedals pedals{};
    for (std::size_t channel = 0; channel < pedals.size(); ++channel)
        pedals[channel] = state.channels[channel].sustain;
    std::uint64_t order = state.note_order;
    Notes found{notes};
    for (const InstrumentEvent& event : events) {
        if (event.channel < 0 || event.channel >= midi_channels) continue;
        if (event.type == InstrumentEventType::Sustain) move_pedal(state, event, pedals);
        if (!is_note(event)) continue;
        if (!begins(event)) {
            let_go(state, event, pedals);
            continue;
        }
        const std::size_t course = take_course(model, state, event, order++);
        if (course != no_course) add_course(model, course, event.key, found);
    }
    for (std::size_t c = 0; c < state.courses.size(); ++c) state.courses[c].held = before[c];
    return found.count;
}

}  // namespace jawari
