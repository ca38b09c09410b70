// What rendering may skip. Each option can be switched off to measure its benefit; results always agree with
// uniform stepping up to rounding.
#pragma once

namespace jawari {

/// Which shortcuts rendering takes. The exact scheme has them; the theta scheme steps uniformly.
struct Skipping {
    bool flight = true;       ///< cross free frames with one 2x2 matrix per mode instead of step by step
    bool certificate = true;  ///< do not evaluate contacts that provably stay open in a frame
    bool near = true;         ///< in frames with a contact that may close, evaluate only such contacts
    /// Leave modes below lazy_threshold of the strongest out of the sums until an impulse or a force comes.
    bool lazy = true;
    bool sleep = true;  ///< spend nothing on strings below sleep_threshold of their strongest state
};

/// Every shortcut.
inline constexpr Skipping skip_all{};
/// Uniform stepping with all contacts.
inline constexpr Skipping skip_nothing{false, false, false, false, false};

/// A mode leaves the sums when both its displacement and its velocity bound are below this share of the
/// string's largest.
inline constexpr double lazy_threshold = 1e-16;
/// A string is put to rest when all its displacement and velocity bounds are below this share of the largest
/// ever seen.
inline constexpr double sleep_threshold = 1e-20;

}  // namespace jawari
