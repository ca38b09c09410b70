// The least CPU time of several runs of a deterministic computation: the one least disturbed by the machine.
#pragma once

#include <algorithm>
#include <limits>

#include "base/cpu_clock.h"
#include "jawari/denormals.h"
#include "trajectory.h"

namespace jawari::benchmarks {

/// Calls `prepare()` unmeasured and `run()` measured, again and again; the least CPU time of one run [s].
/// Denormals are off for every method: they would slow down what nobody hears, by how much depends on the
/// processor.
template <class Prepare, class Run>
double least_cpu_s(const Repetition& repetition, Prepare&& prepare, Run&& run) {
    const NoDenormals guard;
    double least = std::numeric_limits<double>::infinity(), total = 0;
    for (int i = 0; i < repetition.most && (i == 0 || total < repetition.enough_s); ++i) {
        prepare();
        const double start = host::thread_cpu_s();
        run();
        const double cpu_s = host::thread_cpu_s() - start;
        least = std::min(least, cpu_s);
        total += cpu_s;
    }
    return least;
}

}  // namespace jawari::benchmarks
