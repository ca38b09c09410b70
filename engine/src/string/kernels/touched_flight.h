// Free flight under forces that are held at places of a string, and what the places do next, in one sweep.
#pragma once

#include <array>
#include <cstddef>

#include "jawari/detail/string_model.h"

namespace jawari::kernels {

/// Most forces of one sweep.
inline constexpr std::size_t most_flight_forces = 4;

/// A frame of a string under forces held at the places of `row`.
struct TouchedFlight {  // NOLINT(cppcoreguidelines-pro-type-member-init): the first `count` of arrays are set
    std::size_t modes = 0;  ///< padded
    double lag = 0;         ///< of w = row (q - lag v) [s]
    const FlightModel* flight = nullptr;
    const double *q = nullptr, *v = nullptr;
    double *q_out = nullptr, *v_out = nullptr;
    std::size_t count = 0;  ///< of forces, 1 to most_flight_forces
    std::array<const double*, most_flight_forces> row;
    std::array<double, most_flight_forces> force_N;
    const double* read_row = nullptr;  ///< of displacements; its product at the frame's end goes to `reading`
    bool looks_ahead = false;          ///< whether `middle` and `rise` of the next frame are asked for

    double reading = 0;
    std::array<double, most_flight_forces> middle;  ///< w at the frame's end, as free_paths() has it
    std::array<double, most_flight_forces> rise;    ///< its change over the next frame in free flight
};

/// q_out, v_out and the results. Returns false if the frame's end is not finite.
bool fly_touched(TouchedFlight& run) noexcept;

}  // namespace jawari::kernels
