// `jawari bench-latency`: measures what the options ask for.
#pragma once

#include "common/error.h"
#include "latency/options.h"

namespace jawari::host {

MaybeError bench_latency(const LatencyOptions& options);

}  // namespace jawari::host
