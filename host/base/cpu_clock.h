// CPU time, the denominator of real_time_factor.
#pragma once

namespace jawari::host {

/// CPU seconds that the calling thread has used.
double thread_cpu_s();

}  // namespace jawari::host
