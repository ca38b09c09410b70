// CPU time, the denominator of real_time_factor.
#pragma once

#include <ctime>

namespace jawari::host {

/// CPU seconds that the calling thread has used.
inline double thread_cpu_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace jawari::host
