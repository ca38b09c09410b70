// How finely to compute: contact rate and number of modes from the error that is allowed.
#pragma once

#include <cstddef>

#include "jawari/scene/description.h"

namespace jawari {

/// Named errors.
enum class Quality {
    Live,      ///< for playing: error_target 20 %
    Studio,    ///< for rendering: 1 %
    Reference  ///< for measuring: 0.1 %
};

/// The quality's name: live, studio or reference. Static storage. Threads: any; realtime-safe.
const char* name_of(Quality quality);

/// Error that a quality stays below: the relative L2 error over the first 0.1 s of the published bass
/// (`lab/bass`, `signorini`), all probes. Other scenes differ: docs/benchmarks.md has a table of the guitar
/// too. Threads: any; realtime-safe.
double error_target(Quality quality);

/// What sets the error.
struct Resolution {
    double contact_rate_hz = 0;  ///< contact steps per second, a multiple of the output rate [Hz]
    double mode_limit_hz = 0;    ///< modes above this frequency are left out [Hz]
};

/// The coarsest resolution that stays below `error` (1e-6 to 1) on the published bass. `output_rate_hz`:
/// above 0. The contact law is of first order: error = 0.95 % MHz / contact rate. The error of missing modes
/// comes from a measured table. Both add up as squares. benchmarks/speed/resolution_errors.cpp measured them.
/// Threads: any.
Resolution resolution_for(double error, double output_rate_hz);

/// Error that a contact rate leaves on the published bass with all its modes (resolution_for()), the
/// published bass being scaled in time to another fundamental: times and rates scale alike. Above 1: nothing
/// is right. `fundamental_hz`, `contact_rate_hz`: above 0. Threads: any; realtime-safe.
double contact_error(double fundamental_hz, double contact_rate_hz);

/// Leaves out all modes of the string but the first `count` and those up to the last that a probe reads, in
/// its tables and in its initial state; nothing if it has no more. `count`: from 1. Precondition: compile()
/// accepts the description. Threads: any.
void keep_modes(StringDescription& string, std::size_t count);

/// The scene at the resolution of a quality: its modes cut, its contact rate set. Precondition: compile()
/// accepts the scene. Threads: any. Allocates.
SceneDescription at_quality(SceneDescription scene, Quality quality);

}  // namespace jawari
