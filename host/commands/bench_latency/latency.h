// `jawari bench-latency`: measures what the options ask for.
#pragma once

#include "base/error.h"
#include "commands/bench_latency/options.h"

namespace jawari::host {

MaybeError bench_latency(const LatencyOptions& options);

}  // namespace jawari::host
