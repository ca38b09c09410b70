// A day of playing, as fast as it renders: the same minute of music over and over, and what changes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "instrument/instrument_cache.h"

namespace jawari::soak {

/// What one minute was like.
struct Minute {
    double pitch_hz = 0;      ///< of the string that rings on, while it is alone
    double level = 0;         ///< root of the mean square of the whole minute, full scale 1
    double energy_J = 0;      ///< of all strings, while one rings on
    double resident_kib = 0;  ///< memory of the process
};

struct LongPlay {
    std::vector<Minute> minutes;
    std::uint64_t notes = 0;
    std::uint64_t nonfinite_resets = 0, dropped_messages = 0;
    double cpu_s = 0;
};

/// Between the first and the last minutes.
struct Drift {
    double pitch_cents = 0;
    double level_db = 0;
    double energy_db = 0;
    double resident_kib = 0;
};

/// Plays `minutes` through LivePlayer, messages in and samples out. `goes_on` is asked after each. An open
/// string is plucked again and again and never damped, so that its state is never that of the start; phrases
/// with bends, pedal and controllers pass over the other strings.
LongPlay play_long(const host::SharedInstrument& instrument, double rate_hz, std::uint64_t minutes,
                   const std::function<bool(const LongPlay&)>& goes_on);

/// Of the means over the first and the last `count` minutes; the very first, which starts from rest, is left
/// out.
Drift drift_of(const std::vector<Minute>& minutes, std::size_t count);

}  // namespace jawari::soak
