// What a live performance costs and does: written by the audio thread, read by any other, without locks.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "jawari/parameters.h"

namespace jawari::host {

/// Messages that meant something, but not here, by kind.
struct LiveIgnored {
    std::array<std::uint64_t, 128> controllers{};
    std::uint64_t data = 0;            ///< data entry of RPNs and NRPNs without a meaning
    std::uint64_t moved_notes = 0;     ///< tuned or transposed beyond the keys 0 to 127
    std::uint64_t unplayed_notes = 0;  ///< of channels without a string in guitar mode
};

/// A snapshot; each number is right by itself, all together may be of two blocks.
struct LiveStatistics {
    std::uint64_t blocks = 0;            ///< calls of process()
    std::uint64_t frames = 0;            ///< rendered
    double load = 0;                     ///< of the last block: time taken over time available
    double mean_load = 0;                ///< smoothed over half a second
    double worst_load = 0;               ///< largest since statistics() was asked before
    double peak_left = 0;                ///< largest magnitude since statistics() was asked before
    double peak_right = 0;               ///< likewise
    std::uint64_t late_blocks = 0;       ///< that took longer than they last
    std::uint64_t xruns = 0;             ///< reported by report_xrun()
    std::uint64_t messages = 0;          ///< of MIDI, applied
    std::uint64_t dropped_messages = 0;  ///< lost because a port was full
    std::size_t instruments = 0;         ///< that sound or ring out
    std::size_t held_notes = 0;          ///< keys and pedal
    std::size_t voices = 0;              ///< motions that are not at rest
    double energy_J = 0;                 ///< of all strings, refreshed string by string
    int overload_level = 0;              ///< 0: full quality (governor.h)
    std::uint64_t overload_changes = 0;
    std::uint64_t notes = 0;          ///< excited
    std::uint64_t ignored_notes = 0;  ///< out of range or without a string
    std::uint64_t stolen_notes = 0;   ///< held notes whose string was taken by another
    std::uint64_t faded_voices = 0;   ///< taken away before they were at rest
    std::uint64_t nonfinite_resets = 0;
    double limiter_gain = 1;  ///< least since the start
    LiveIgnored ignored;
};

/// The audio thread's side. Every store is relaxed and has one writer.
struct LiveMeters {
    std::atomic<std::uint64_t> blocks{0}, frames{0}, late_blocks{0}, messages{0}, overload_changes{0},
        notes{0}, ignored_notes{0}, stolen_notes{0}, faded_voices{0}, nonfinite_resets{0};
    std::atomic<std::uint64_t> xruns{0};  ///< written by the audio system's thread
    std::atomic<std::size_t> instruments{0}, held_notes{0}, voices{0};
    std::atomic<double> load{0}, mean_load{0}, worst_load{0}, peak_left{0}, peak_right{0}, energy_J{0},
        limiter_gain{1};
    std::atomic<int> overload_level{0};
    std::array<std::array<std::atomic<double>, parameter_count>, 16> parameters{};  ///< by channel
    std::array<std::atomic<std::uint64_t>, 128> ignored_controllers{};
    std::atomic<std::uint64_t> ignored_data{0}, moved_notes{0}, unplayed_notes{0};
};

/// Empties what is counted since the last call.
LiveStatistics take_statistics(LiveMeters& meters);

}  // namespace jawari::host
