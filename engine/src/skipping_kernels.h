// The loops over modes that skipping adds: free flight over a frame, and the bounds of the gap certificate.
#pragma once

#include <cstddef>

#include "jawari/model.h"

namespace jawari::kernels {

/// (q_out, v_out) <- (q, v) + F (q, v) over n modes. Returns false if a result is not finite.
bool fly(std::size_t n, const FlightModel& flight, const double* q, const double* v, double* q_out,
         double* v_out) noexcept;

/// Adds the response to modal forces held + elapsed ramp + ramp n (n = 0..m-1) to the frame's end. Returns
/// false if a result is not finite. Without a ramp, `ramp` is null.
bool add_force_response(std::size_t n, const FlightModel& flight, const double* held, const double* ramp,
                        double elapsed, double* q, double* v) noexcept;

struct LargestBounds {
    double speed = 0;
    double extent = 0;
};

/// speed <- r_k, extent <- bound of |q_k|, detour <- min(T^2/8 bound of |acceleration|, 2 extent), for all
/// later free steps.
LargestBounds mode_bounds(std::size_t n, const StringModel& model, const double* q, const double* v,
                          double* speed, double* extent, double* detour) noexcept;

}  // namespace jawari::kernels
