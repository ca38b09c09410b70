// How finely to compute: contact rate and modes from the error that is allowed.
#pragma once

#include "jawari/scene/description.h"

namespace jawari {

enum class Quality {
    Live,      ///< for playing: error_target 20 %
    Studio,    ///< for rendering: 1 %
    Reference  ///< for measuring: 0.1 %
};

/// live, studio, reference
const char* name_of(Quality quality);

/// Relative L2 error over the first 0.1 s of the published bass (`lab/bass`, `signorini`), all probes, that a
/// quality stays below. Other scenes differ: docs/benchmarks.md has the guitar's table beside.
double error_target(Quality quality);

struct Resolution {
    double contact_rate_hz = 0;  ///< a multiple of the output rate
    double mode_limit_hz = 0;    ///< modes above it are left out
};

/// The coarsest resolution that stays below `error` (1e-6 to 1) on the published bass. The contact law is of
/// first order, error = 1.4 % MHz / contact rate; missing modes are read off a measured table; both add up as
/// squares. The command that measured both is benchmarks/speed/resolution_errors.cpp.
Resolution resolution_for(double error, double output_rate_hz);

/// The scene at the resolution of a quality: its modes cut, its contact rate set.
SceneDescription at_quality(SceneDescription scene, Quality quality);

}  // namespace jawari
