// The loops over modes that instruments add to those of strings (string/kernels), dispatched at run time.
#pragma once

#include <array>
#include <cstddef>

#include "jawari/detail/string_model.h"
#include "jawari/detail/touches.h"
#include "jawari/instrument/model.h"

namespace jawari::kernels {

/// What modes [begin, end) do under all rows.
void free_paths(std::size_t begin, std::size_t end, double lag, const FlightModel& flight, const double* q,
                const double* v, TouchedRows& rows) noexcept;

/// Most rows of one sweep of compliances_of().
inline constexpr std::size_t most_compliant_rows = 4;

/// out[i * count + j] <- sum_k row_i (q_held - lag v_held) row_j over the first n modes: how far i has moved
/// at a frame's end per newton held at j, for `count` rows, 1 to most_compliant_rows.
void compliances_of(std::size_t n, std::size_t count, double lag, const FlightModel& flight,
                    const double* const* rows, double* out) noexcept;

/// Averaging of sine shapes over a width.
struct PointShape {
    double scale = 1;  ///< amplitude of the shapes
    double a = 0;      ///< pi x/L
    double b = 0;      ///< pi width/(2 L); 0: a point
};

/// row[k] <- scale sin((k+1) a) sin((k+1) b)/((k+1) b), k < n (padded)
void point_row(std::size_t n, const PointShape& shape, double* row) noexcept;

/// A frame of the body's modes, see BodyModel.
struct BodyFrame {
    double left = 0, right = 0;  ///< sum of gain v
    double largest = 0;          ///< of the larger gain times |v| now and before
};
BodyFrame advance_body(std::size_t n, const BodyModel& body, double force_before_N, double force_change_N,
                       double* y, double* v) noexcept;

}  // namespace jawari::kernels
