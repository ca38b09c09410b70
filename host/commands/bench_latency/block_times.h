// How long blocks take: the distribution of their CPU time under adversarial playing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/error.h"
#include "commands/bench_latency/adversary.h"
#include "instrument/instrument_cache.h"
#include "plugin/core/plugin_state.h"

namespace jawari::host {

struct BlockTimeSettings {
    double rate_hz = 48000;
    std::size_t frames = 64;      ///< of a block
    std::uint64_t blocks = 1000;  ///< played in each pass
    std::size_t passes = 7;       ///< identical ones; what differs between them is the machine
    std::uint32_t seed = 1;
    AdversaryReach reach = AdversaryReach::AllCourses;
    bool plugin = false;       ///< the way through the plugin instead of that of jawari play
    PluginState plugin_state;  ///< then in force, with the instrument in it
    bool governor = false;     ///< passes then differ: quality follows the machine
    std::function<void(double fraction)> progress;  ///< may be empty
};

/// Thread CPU time of LivePlayer::process(), or of a block of PluginCore, as a share of the time that the
/// block lasts.
struct BlockTimes {
    std::vector<float> raw;      ///< of every block of every pass
    std::vector<float> minimum;  ///< of each block, over the passes: rendering is deterministic, so what is
                                 ///< left out is the machine's (scheduler, interrupts, caches of others)
    std::uint64_t notes = 0;     ///< excited in a pass
    std::uint64_t late = 0;      ///< blocks of all passes that took longer than they last, by the wall clock
};

/// Ends early with the interruption's error on SIGINT, SIGTERM or SIGHUP.
Outcome<BlockTimes> measure_blocks(const SharedInstrument& instrument, const BlockTimeSettings& settings);

struct Distribution {
    double median = 0, p99 = 0, p99_99 = 0, most = 0, mean = 0;
    std::size_t count = 0;
};

/// Order statistics: the smallest value that at least that share of all values does not exceed. Of an empty
/// list all are 0.
Distribution distribution_of(std::vector<float> values);

}  // namespace jawari::host
