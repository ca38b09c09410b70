// Legato: the ringing shape of a string carried over to another speaking length.
#pragma once

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Modes of the old and of the new length that take part: beyond them the new voice starts at rest.
inline constexpr std::size_t transfer_modes = 256;

/// Gives `to`, which is at rest at its fret, the shape and true velocity of `from`, seen from the bridge. At
/// a new end inside the old length the shape is made zero there by taking out its linear ramp; beyond an old
/// end the string is at rest.
void carry_over(const InstrumentStringModel& string, const Voice& from, Voice& to,
                PlayerWork& work) JAWARI_REALTIME;

/// A slide's end: gives `to`, which is at rest at its fret, each partial of `from`, which is bent to the
/// pitch of that fret, with its energy and phase. A string whose length changes slowly keeps them: no shape
/// is cut.
void keep_partials(const InstrumentStringModel& string, const Voice& from, Voice& to,
                   PlayerWork& work) JAWARI_REALTIME;

}  // namespace jawari
