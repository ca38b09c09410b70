// The loops over modes that skipping adds beside free flight: forces over a frame, and the bounds of the gap
// certificate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "jawari/detail/string_model.h"

namespace jawari::kernels {

/// Adds the response to modal forces held + elapsed ramp + ramp n (n = 0..m-1) to the frame's end. Returns
/// false if a result is not finite. Without a ramp, `ramp` is null.
bool add_force_response(std::size_t n, const FlightModel& flight, const double* held, const double* ramp,
                        double elapsed, double* q, double* v) noexcept;

/// Sums over modes of what forces do in the unit of time: with F the larger of the modal force's values at
/// the frame's ends, and V its value at the start plus its change.
struct ForceBounds {
    double speed = 0;      ///< sum kick F
    double extent = 0;     ///< sum kick extent F
    double detour = 0;     ///< sum kick detour F
    double variation = 0;  ///< sum kick V
};

/// Over modes [begin, end), for modal forces held + n ramp, n from `first` to `last`.
ForceBounds force_bounds(std::size_t begin, std::size_t end, const CertificateTuning& certificate,
                         const double* held, const double* ramp, double first, double last) noexcept;

/// The same for modal forces that stay at 1.
ForceBounds unit_force_bounds(std::size_t begin, std::size_t end,
                              const CertificateTuning& certificate) noexcept;

struct StepImpulse {
    std::size_t struck = 0;  ///< contact
    double impulse = 0;      ///< [N s]
    std::size_t step = 0;    ///< of the frame
};

/// rates += what the impulse does to the rates of the near contacts at all later steps of the frame, by
/// StringTuning::response; rows in the order of `near`, response_stride apart.
void spread_impulse(const StringModel& model, std::span<const std::uint32_t> near, const StepImpulse& step,
                    double* rates) noexcept;

struct LargestBounds {
    double speed = 0;
    double extent = 0;
};

/// speed <- r_k, extent <- bound of |q_k|, detour <- how far q_k may leave the line between a frame's ends;
/// for all later free steps.
LargestBounds mode_bounds(std::size_t n, const StringModel& model, const double* q, const double* v,
                          double* speed, double* extent, double* detour) noexcept;

}  // namespace jawari::kernels
