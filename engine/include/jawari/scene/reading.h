// Linear readings of a string: what probes, pickups and bridges take from its modes at each output frame.
#pragma once

namespace jawari {

/// A linear reading of a string: out[n] = sum_k row_k q_k, or v_k, for frame n of a block.
struct Reading {
    const double* row = nullptr;  ///< over modes, padded and aligned like the model's rows
    bool of_velocity = false;
    double* out = nullptr;
};

/// When a frame is read.
enum class ReadAt { Start, End };

}  // namespace jawari
