// Which courses play notes that begin together.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "instrument/play/course_choice.h"

namespace jawari {

/// Events that are looked at together; the rest of a longer run is the next chord.
inline constexpr std::size_t largest_chord = limits::instrument_strings;

/// For each event of a chord the course of its note, or no_course where choose_course() is to decide.
using ChordCourses = std::array<std::size_t, largest_chord>;

/// Chooses for the note-ons among events of one frame, at most largest_chord; they are valid. Each takes the
/// free course with the lowest fret, as choose_course() does; where none is free, notes of the chord move
/// over to other free courses along a shortest augmenting path, so that as many notes sound as any choice
/// allows (bipartite matching; Berge 1957). Notes that are held already, that name their string, or continue
/// another in legato are left to the caller. At most chord * courses^2 operations.
void choose_chord(const InstrumentModel& model, const InstrumentState& state,
                  std::span<const InstrumentEvent> chord, ChordCourses& courses) JAWARI_REALTIME;

}  // namespace jawari
