// The loops over modes that instruments add to those of strings (kernels.h), dispatched at run time.
#pragma once

#include <cstddef>

#include "jawari/instrument_model.h"
#include "jawari/model.h"

namespace jawari::kernels {

/// middle <- q - lag v, rise <- its change over the frame in free flight.
void free_path(std::size_t n, double lag, const FlightModel& flight, const double* q, const double* v,
               double* middle, double* rise) noexcept;

/// path <- q - lag v - middle
void path_since(std::size_t n, double lag, const double* q, const double* v, const double* middle,
                double* path) noexcept;

/// out <- row (q_held - lag v_held): how far the modes have moved at a frame's end per newton held on the
/// row.
void moved_by_held(std::size_t n, double lag, const FlightModel& flight, const double* row,
                   double* out) noexcept;

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
