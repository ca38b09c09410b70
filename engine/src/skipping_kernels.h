// The loops over modes that skipping adds beside free flight: forces over a frame, and the bounds of the gap
// certificate.
#pragma once

#include <cstddef>

#include "jawari/model.h"

namespace jawari::kernels {

/// Adds the response to a force F + rate n (n = 0..m-1) on `row` to the frame's end. Returns false if a
/// result is not finite.
bool add_force_response(std::size_t n, const FlightModel& flight, double force, double rate,
                        const double* row, double* q, double* v) noexcept;

/// y <- y + scale (a - b) over any n, without alignment
void add_difference(std::size_t n, double scale, const double* a, const double* b, double* y) noexcept;

struct LargestBounds {
    double speed = 0;
    double extent = 0;
};

/// speed <- r_k, extent <- bound of |q_k|, detour <- how far q_k may leave the line between a frame's ends;
/// for all later free steps.
LargestBounds mode_bounds(std::size_t n, const StringModel& model, const double* q, const double* v,
                          double* speed, double* extent, double* detour) noexcept;

}  // namespace jawari::kernels
