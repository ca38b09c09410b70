// What a body under a moving bridge does to one string alone: where its partials go, and what it takes of
// them.
#pragma once

#include <vector>

#include "jawari/instrument/description.h"
#include "jawari/scene/description.h"

namespace jawari {

/// Frequency of the first partial of string `index`, `stopped` as it is on a rigid bridge, when the bridge
/// moves [Hz]: the eigenvalue of the string with the body, without other strings.
double coupled_first_partial(const InstrumentDescription& instrument, std::size_t index,
                             const StringDescription& stopped);

/// What the body takes of each partial in the mean over a third octave [1/s].
std::vector<double> body_losses(const InstrumentDescription& instrument, std::size_t index,
                                const StringDescription& stopped);

}  // namespace jawari
