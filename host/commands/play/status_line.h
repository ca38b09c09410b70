// The line that is always there while one plays: level, load, notes, trouble.
#pragma once

#include <cstddef>
#include <string>

#include "player/statistics.h"

namespace jawari::host {

struct StatusFacts {
    LiveStatistics live;  ///< its peaks and worst load are those since the line was drawn before
    std::string preset;
    double worst_load = 0;  ///< of the whole performance
    bool audio_runs = true;
    double recorded_s = -1;  ///< below 0: nothing is being recorded
};

/// At most `columns` characters, all of them one column wide.
std::string status_text(const StatusFacts& facts, std::size_t columns);

/// `#########----|` of `width` characters: -60 dBFS to 0 dBFS.
std::string meter(double peak, std::size_t width);

}  // namespace jawari::host
