// What came of one seed, and how it is printed.
#pragma once

#include <cstdint>
#include <string>

#include "judge.h"

namespace jawari::stress {

struct Report {
    std::uint64_t seed = 0;
    std::string kind;
    std::string refused;  ///< why compile() would not have it; empty if it did
    std::uint64_t blocks = 0, frames = 0, strings = 0, contacts = 0, impulses = 0, notes = 0;
    std::uint64_t truncated = 0;  ///< solves
    bool exploded =
        false;  ///< energy near overflow, by a law that injects it or by the player: the scene ends there
    double sound_s = 0;
    double cpu_s = 0;
    Judge judge;
};

/// How long a scene is played.
struct Budget {
    double cpu_s = 0.1;        ///< thread CPU time, both passes; the block under way is finished
    std::uint64_t blocks = 0;  ///< above 0: exactly so many instead
};

/// One line of JSON.
std::string json_line(const Report& report);

/// One line for each violation, with the command that replays it.
std::string violation_lines(const Report& report);

}  // namespace jawari::stress
