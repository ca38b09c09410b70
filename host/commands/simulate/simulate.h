// `jawari simulate`: a scene in, its probes, statistics and pictures out.
#pragma once

#include "base/error.h"
#include "commands/simulate/options.h"

namespace jawari::host {

/// Files appear whole or not at all, and only after everything else has succeeded.
MaybeError simulate(const SimulateOptions& options);

}  // namespace jawari::host
