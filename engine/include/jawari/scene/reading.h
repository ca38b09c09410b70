// Linear readings of a string: what probes, pickups and bridges take from its modes at each output frame.
#pragma once

namespace jawari {

/// A linear reading of a string: out[n] = sum_k row_k q_k, or sum_k row_k v_k, for frame n of a block.
struct Reading {
    const double* row = nullptr;  ///< StringModel::stride values over modes, aligned to vector_alignment
    bool of_velocity = false;     ///< reads v instead of q
    double* out = nullptr;        ///< room for the block's frames
};

/// When an output frame is read.
enum class ReadAt {
    Start,  ///< before the state advances
    End     ///< after the state has advanced
};

}  // namespace jawari
