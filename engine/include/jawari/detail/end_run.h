// A voice on a moving bridge that flies through a run of output frames: plain state, which
// engine/src/instrument/voice/end_run.cpp writes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "jawari/detail/aligned.h"

namespace jawari {

/// Most output frames of a run.
inline constexpr std::size_t longest_end_run = 32;
/// Values of a reading over a run: at all ends of its frames, with room for vectors that reach beyond.
inline constexpr std::size_t end_run_stride = longest_end_run + 2 * lane_padding;

/// How a string and its end move through a run: arrays over modes. With the free motion A of a frame and beta
/// = (q_held, v_held) b, what a metre of the bridge's displacement in a frame does to the mode by its end:
struct EndCoefficients {
    AlignedVector<double> trace;        ///< of A
    AlignedVector<double> determinant;  ///< of A
    AlignedVector<double> qq;           ///< A^n - I, n = longest_end_run: q from q
    AlignedVector<double> qv;           ///< q from v [s]
    AlignedVector<double> vq;           ///< v from q [1/s]
    AlignedVector<double> vv;           ///< v from v
    AlignedVector<double> still;        ///< q at rest with the end at 1 m
    AlignedVector<double> q_last;       ///< beta
    AlignedVector<double> v_last;       ///< beta
    AlignedVector<double> q_before;     ///< (A - trace) beta
    AlignedVector<double> v_before;     ///< (A - trace) beta
};

/// A run. While it lasts, the string's displacement and velocity are those of its start.
struct EndRun {
    EndCoefficients coefficients;     ///< of the voice's string at its tension
    AlignedVector<double> responses;  ///< of each reading to the end: at the ends of the frame and of those
                                      ///< that follow, per metre; readings x end_run_stride
    /// What is read of the string at the start of each frame and at the end of the last, for frames to come
    /// as if the end stood still from now on: the force on the bridge [N], then what the outputs read.
    AlignedVector<double> readings;
    std::array<double, longest_end_run> zeta_m{};  ///< displacement of the end in the frames passed [m]
    std::size_t modes = 0;                         ///< that the run moves (padded)
    std::size_t reach = 0;         ///< that the end moves (padded); those behind fly by themselves
    std::size_t count = 0;         ///< readings
    std::size_t frames = 0;        ///< of the run; 0: there is none
    std::size_t passed = 0;        ///< of them
    std::uint64_t not_before = 0;  ///< StringState::frame before which no run begins
    double bend = 0;      ///< by which a metre of the end at rest bends the string at a contact at most [1]
    double sway = 0;      ///< and by which the string sways at most when the end goes back by a metre [1]
    double still_m = 0;   ///< where the end was in the frame before the run [m]
    double travel_m = 0;  ///< of the end since then [m]
    double most_travel_m = 0;  ///< that the run allows [m]
    double swing_m = 0;        ///< travel with which the next run reckons [m]
    bool outdated = true;      ///< coefficients and responses must be computed anew
    bool finite = true;        ///< what is shown is
    bool shown = false;  ///< displacement and velocity are those of now, and those of the start lie in the
                         ///< string's displacement_flown and velocity_flown
};

}  // namespace jawari
