// What the command line of `jawari bench-latency` says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "jawari/scene/resolution.h"

namespace jawari::host {

struct LatencyOptions {
    std::vector<std::string> presets;  ///< empty: the heaviest_presets heaviest, and the steel-string guitar
    std::vector<std::size_t> frames{16, 32, 64, 128};  ///< sizes of blocks
    std::uint64_t blocks = 1'000'000;                  ///< timed for each preset and size, over all passes
    std::uint64_t passes = 7;                          ///< identical ones
    std::uint32_t rate_hz = 48000;
    Quality quality = Quality::Live;
    std::uint32_t seed = 1;
    bool plugin = false;     ///< times the plugin's blocks
    bool governor = false;   ///< quality may drop, as when playing live
    bool two_hands = false;  ///< ten keys at once, AdversaryReach::TwoHands
    std::string json;        ///< a file; `-`: standard output instead of the table
    std::string csv;         ///< a file
    std::string plot;        ///< histograms, .svg or .png
    bool overwrite = false;  ///< replaces files of other kinds too
};

inline constexpr std::size_t heaviest_presets = 3;

}  // namespace jawari::host
