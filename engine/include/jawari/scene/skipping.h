// What rendering may skip. Every choice gives the numbers of uniform stepping to rounding; they exist to be
// measured apart.
#pragma once

namespace jawari {

struct Skipping {
    bool flight = true;       ///< free frames in one 2x2 matrix per mode instead of step by step
    bool certificate = true;  ///< contacts that provably stay open in a frame are not evaluated
    bool near = true;         ///< frames with a contact that may close evaluate only such contacts
    bool lazy =
        true;  ///< modes below lazy_threshold of the strongest leave the sums until an impulse or a force
    bool sleep = true;  ///< strings below sleep_threshold of their strongest state cost nothing
};

inline constexpr Skipping skip_all{};
inline constexpr Skipping skip_nothing{false, false, false, false, false};

/// A mode leaves the sums when both its displacement and its velocity bound are below this share of the
/// string's largest.
inline constexpr double lazy_threshold = 1e-16;
/// A string is put to rest when all its displacement and velocity bounds are below this share of the largest
/// ever seen.
inline constexpr double sleep_threshold = 1e-20;

}  // namespace jawari
