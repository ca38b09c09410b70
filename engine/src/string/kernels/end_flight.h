// A string that flies through a run of output frames while its end follows a bridge: what rows read of it as
// long as the end stands still, and where its modes are once the end's motion is known.
//
// A mode's free motion over a frame, A, obeys A^2 = trace A - determinant. What is read of it obeys the same
// recurrence from frame to frame, and so does the sum of what the end did to it:
//     sum_n zeta_n A^(N-1-n) beta = g_(N-1) beta + g_(N-2) (A - trace) beta,  g_n = zeta_n + trace g_(n-1) -
//     determinant g_(n-2)
#pragma once

#include <array>
#include <cstddef>

#include "jawari/detail/end_run.h"
#include "jawari/detail/string_model.h"

namespace jawari::kernels {

/// The first n modes (padded) of `coefficients`, for a row `end` of the bridge's end.
void set_end_coefficients(std::size_t n, const FlightModel& flight, const double* end,
                          EndCoefficients& coefficients) noexcept;

/// Most rows of one EndReading.
inline constexpr std::size_t most_end_rows = 2;

/// Rows that read of_q q + of_v v of modes in free flight.
struct EndReading {  // NOLINT(cppcoreguidelines-pro-type-member-init): the first `rows` of arrays are set
    std::size_t modes = 0;   ///< padded
    std::size_t frames = 0;  ///< at most longest_end_run
    const FlightModel* flight = nullptr;
    const EndCoefficients* coefficients = nullptr;
    const double *q = nullptr, *v = nullptr;
    double of_q = 1, of_v = 0;
    std::size_t rows = 0;  ///< 1 to most_end_rows
    std::array<const double*, most_end_rows> row;
    std::array<double*, most_end_rows> out;  ///< [0, frames]: at the start and at the end of each frame
};
void read_end_run(const EndReading& run) noexcept;

/// values[n] += zeta response[n] for n < count, which vectors may overstep to the next multiple of
/// lane_padding, of `readings` arrays that lie end_run_stride apart.
void add_end_response(std::size_t readings, std::size_t count, double zeta, const double* response,
                      double* values) noexcept;

/// q, v <- after longest_end_run frames with the end at zeta[n] in frame n. Returns false if they are not
/// finite.
bool end_long_run(std::size_t modes, const EndCoefficients& coefficients, const double* zeta, double* q,
                  double* v) noexcept;

/// q_out, v_out <- the same after `frames` frames, step by step.
bool end_short_run(std::size_t modes, std::size_t frames, const FlightModel& flight,
                   const EndCoefficients& coefficients, const double* zeta, const double* q, const double* v,
                   double* q_out, double* v_out) noexcept;

}  // namespace jawari::kernels
