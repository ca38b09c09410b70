// CPU time of rendering a scene.
#pragma once

#include "jawari/jawari.h"

namespace jawari::benchmarks {

struct Measurement {
    double sound_s = 0;
    double cpu_s = 0;   ///< the least of all repetitions, this thread's CPU time
    Counters counters;  ///< of the measured stretch, all strings
};

/// Renders `skip_s` seconds unmeasured, then `sound_s` seconds, `repetitions` times from the start. Rendering
/// is deterministic, so the least time is the one least disturbed by the machine.
Measurement measure(const SceneModel& model, double sound_s, const Skipping& skipping = skip_all,
                    double skip_s = 0, int repetitions = 5);

}  // namespace jawari::benchmarks
