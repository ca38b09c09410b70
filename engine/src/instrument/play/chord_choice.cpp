#include "instrument/play/chord_choice.h"

#include "base/assert.h"

namespace jawari {
namespace {

constexpr std::size_t no_note = no_course;

/// The chord so far.
struct Matching {
    const InstrumentModel& model;
    std::span<const InstrumentEvent> chord;                           ///< and what is between its notes
    ChordCourses& course_of;                                          ///< of each note
    std::array<std::size_t, limits::instrument_strings> note_of{};    ///< of each course, or no_note
    std::array<bool, limits::instrument_strings> blocked{};           ///< courses with a note of before
    std::array<std::size_t, limits::instrument_strings> came_from{};  ///< scratch: on the path's way
    std::array<std::size_t, limits::instrument_strings> queue{};      ///< scratch: courses to look at
    std::array<bool, limits::instrument_strings> seen{};              ///< scratch

    [[nodiscard]] bool is_free(std::size_t course) const {
        return !blocked[course] && note_of[course] == no_note;
    }
};

bool is_lower(const Matching& m, std::size_t course, std::size_t best, int key) {
    return best == no_course || fret_of(m.model, course, key) < fret_of(m.model, best, key);
}

/// The free course with the lowest fret, or no_course.
std::size_t free_course(const Matching& m, int key) {
    std::size_t best = no_course;
    for (std::size_t c = 0; c < m.model.courses.size(); ++c) {
        if (m.is_free(c) && fret_of(m.model, c, key) != no_fret && is_lower(m, c, best, key)) best = c;
    }
    return best;
}

/// Notes move along the path that ends at `course`, from course to course; the first one gets the new note.
void move_along(Matching& m, std::size_t course, std::size_t note) {
    for (std::size_t from = m.came_from[course]; from != no_course; from = m.came_from[course]) {
        m.note_of[course] = m.note_of[from];
        m.course_of[m.note_of[course]] = course;
        course = from;
    }
    m.note_of[course] = note;
    m.course_of[note] = course;
}

/// Breadth first from the courses that have the note's key, over the notes of the chord that are on them.
void make_room(Matching& m, std::size_t note) {
    const std::size_t count = m.model.courses.size();
    std::size_t begin = 0;
    std::size_t end = 0;
    m.seen.fill(false);
    // Lowest frets first.
    const auto look_at = [&](int key, std::size_t from) {
        const std::size_t first = end;
        for (std::size_t c = 0; c < count; ++c) {
            if (m.seen[c] || m.blocked[c] || fret_of(m.model, c, key) == no_fret) continue;
            m.seen[c] = true;
            m.came_from[c] = from;
            std::size_t place = end++;
            for (; place > first && is_lower(m, c, m.queue[place - 1], key); --place)
                m.queue[place] = m.queue[place - 1];
            m.queue[place] = c;
        }
    };
    look_at(m.chord[note].key, no_course);
    while (begin < end) {
        const std::size_t course = m.queue[begin++];
        if (m.note_of[course] == no_note) {
            move_along(m, course, note);
            return;
        }
        look_at(m.chord[m.note_of[course]].key, course);
    }
}

bool is_repeated(const Matching& m, std::size_t note) {
    for (std::size_t other = 0; other < note; ++other) {
        const InstrumentEvent& before = m.chord[other];
        if (before.type == InstrumentEventType::NoteOn && before.key == m.chord[note].key &&
            before.channel == m.chord[note].channel)
            return true;
    }
    return false;
}

}  // namespace

void choose_chord(const InstrumentModel& model, const InstrumentState& state,
                  std::span<const InstrumentEvent> chord, ChordCourses& courses) JAWARI_REALTIME {
    JAWARI_ASSERT(chord.size() <= largest_chord);
    Matching m{model, chord, courses};
    m.note_of.fill(no_note);
    for (std::size_t c = 0; c < model.courses.size(); ++c) m.blocked[c] = state.courses[c].held.active;
    for (std::size_t note = 0; note < chord.size(); ++note) {
        const InstrumentEvent& event = chord[note];
        courses[note] = no_course;
        if (event.type != InstrumentEventType::NoteOn || event.string >= 0) continue;
        if (course_holding(state, event.channel, event.key) != no_course) continue;
        if (is_repeated(m, note)) continue;  // held by then
        const std::size_t course = free_course(m, event.key);
        if (course != no_course) {
            m.note_of[course] = note;
            courses[note] = course;
        } else {
            make_room(m, note);
        }
    }
}

}  // namespace jawari
