// The engine itself, with and without skipping, as one of the methods of the work-precision diagrams.
#pragma once

#include "jawari/jawari.h"
#include "trajectory.h"

namespace jawari::benchmarks {

/// Throws std::runtime_error if the scene does not compile. Metering is off.
Trajectory run_engine(const SceneDescription& scene, double duration_s, const Skipping& skipping,
                      const Repetition& repetition);

}  // namespace jawari::benchmarks
