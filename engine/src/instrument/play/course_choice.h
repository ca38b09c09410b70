// Which course plays a note. The rules are those of render_instrument().
#pragma once

#include <cstddef>
#include <limits>

#include "jawari/instrument/render.h"

namespace jawari {

inline constexpr std::size_t no_course = std::numeric_limits<std::size_t>::max();
inline constexpr std::size_t no_fret = std::numeric_limits<std::size_t>::max();

/// The fret at which the course's first string has the key, or no_fret.
std::size_t fret_of(const InstrumentModel& model, std::size_t course, int key) JAWARI_REALTIME;

/// The course for a note-on, or no_course.
std::size_t choose_course(const InstrumentModel& model, const InstrumentState& state,
                          const InstrumentEvent& event) JAWARI_REALTIME;

/// The course whose held note is this key of this channel, or no_course.
std::size_t course_holding(const InstrumentState& state, int channel, int key) JAWARI_REALTIME;

/// Whether notes of the channel continue its latest one.
bool plays_legato(const InstrumentState& state, int channel) JAWARI_REALTIME;

/// For legato: the course of the channel's latest note that is down, if it has the key; or no_course.
std::size_t course_to_continue(const InstrumentModel& model, const InstrumentState& state, int channel,
                               int key) JAWARI_REALTIME;

}  // namespace jawari
