// Bends: a voice at another tension than its string was compiled for. Retuning keeps the shape and the true
// velocity, so that energy changes by the parametric work 1/2 mu sum (omega'^2 - omega^2) q^2 alone.
#pragma once

#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/realtime.h"

namespace jawari {

/// Fills what retuning needs to know of a compiled stop.
void set_retuning_tables(StoppedStringModel& stopped);

BendState make_bend_state(const StringSizes& sizes);

/// Puts the voice at once at `semitones` from its compiled pitch; 0 restores the compiled string. The
/// fundamental follows exactly, partials as bending stiffness lets them.
void set_bend(const StoppedStringModel& stopped, Voice& voice, double semitones,
              PlayerWork& work) JAWARI_REALTIME;

/// For a voice that starts anew: as compiled, nothing to convert.
void forget_bend(Voice& voice) JAWARI_REALTIME;

}  // namespace jawari
