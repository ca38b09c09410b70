// The modes of one string run through the fine steps of a frame, in registers: a block of modes at a time,
// all steps of it.
#pragma once

#include <cstddef>

#include "jawari/detail/string_model.h"

namespace jawari::kernels {

struct ModeRun {
    std::size_t modes = 0;  ///< padded
    std::size_t steps = 0;
    double step_s = 0;
    // coefficients over modes: v+ = (carry + change) v + restoring q + sum_f rows_f impulse_f, q+ = q + h v+
    const double* carry = nullptr;
    const double* change = nullptr;
    const double* restoring = nullptr;
    // impulses: `drivers` rows, and their impulses as drivers x impulse_stride
    std::size_t drivers = 0;
    const double* const* driver_rows = nullptr;
    const double* impulses = nullptr;
    std::size_t impulse_stride = 0;
    // rates: `probes` rows, and room for S v+ at each step as probes x rate_stride
    std::size_t probes = 0;
    const double* const* probe_rows = nullptr;
    double* rates = nullptr;
    std::size_t rate_stride = 0;
    double* lanes = nullptr;  ///< scratch: probes x steps_per_run x lane_padding
    // state, in place
    double* q = nullptr;
    double* v = nullptr;
};

/// Steps taken with the state in registers before it goes back to memory.
inline constexpr std::size_t steps_per_run = 32;

/// The coefficients of a model over one frame, all modes, without drivers and probes.
ModeRun frame_run(const StringModel& model) noexcept;

/// Any number of steps.
void run_modes(const ModeRun& run) noexcept;

}  // namespace jawari::kernels
