// What happens on one string when notes begin, go on in legato, and end: which of its voices takes part.
#pragma once

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Excites string s: on the voice that already sounds at that fret, else on one from rest; waits if there is
/// none.
void stroke_string(const InstrumentModel& model, InstrumentState& state, std::size_t s,
                   const Stroke& stroke) JAWARI_REALTIME;

/// Hammer-on, pull-off or slide to another fret: the sounding voice is carried over; a stroke if there is
/// none, or no voice is idle.
void continue_string(const InstrumentModel& model, InstrumentState& state, std::size_t s,
                     const Stroke& stroke) JAWARI_REALTIME;

/// A slide has reached its fret.
void arrive(const InstrumentModel& model, InstrumentState& state, std::size_t s) JAWARI_REALTIME;

/// Note-off: under the damping hand, if there is one.
void release_string(const InstrumentModel& model, InstrumentState& state, std::size_t s,
                    double release_velocity) JAWARI_REALTIME;

/// Fades every voice of the string that belongs to the channel.
void silence_string(const InstrumentModel& model, InstrumentState& state, std::size_t s,
                    int channel) JAWARI_REALTIME;

/// At the start of a frame, once: strokes that wait begin when their time has come and a voice is idle.
void start_pending_strokes(const InstrumentModel& model, InstrumentState& state) JAWARI_REALTIME;

}  // namespace jawari
