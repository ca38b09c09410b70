// One simulation: what a method computes for a scene, and what it cost.
#pragma once

#include <cstddef>
#include <vector>

namespace jawari::benchmarks {

/// Rows 0 to `rows` - 1 of all displacement probes, at t = row/output rate.
struct Trajectory {
    std::size_t rows = 0;
    std::size_t probes = 0;
    std::vector<double> samples;  ///< rows x probes [m]
    double compile_s = 0;         ///< CPU seconds before the first row
    double render_s = 0;          ///< CPU seconds of all rows, the least of the repetitions
    std::size_t unknowns = 0;     ///< modes, or grid points of the finite-difference rival
};

/// How often a simulation is repeated for its least CPU time: until `most` times or `enough_s` seconds.
struct Repetition {
    int most = 3;
    double enough_s = 1;
};

}  // namespace jawari::benchmarks
