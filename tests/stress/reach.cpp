#include "reach.h"

#include <algorithm>
#include <cmath>

#include "jawari/scene/modes.h"

namespace jawari::stress {
namespace {

double square(double x) {
    return x * x;
}

double lag_of(const StringModel& model) {
    return model.scheme == Scheme::Exact ? model.step_s / 2 : 0.0;
}

}  // namespace

Reach reach_of(const StringModel& model, std::span<const double> row) {
    const double lag = lag_of(model);
    double speed = 0, extent = 0, middle = 0;
    for (std::size_t k = 0; k < model.mode_count; ++k) {
        if (row[k] == 0) continue;
        const double share = square(row[k]);
        speed += share / model.kinetic[k];
        middle += share / model.potential[k];
        extent += share * (1 / model.potential[k] + square(lag) / model.kinetic[k]);
    }
    return {std::sqrt(speed), std::sqrt(extent), std::sqrt(middle)};
}

double bound_of(double reach, double energy_J) {
    return std::isfinite(reach) ? reach * std::sqrt(energy_J) : reach;
}

double rounding_share(const StringModel& model) {
    double largest = 0;
    for (std::size_t k = 0; k < model.mode_count; ++k) {
        const double x = model.step_s * std::sqrt(model.potential[k] / model.kinetic[k]);
        largest = std::max(largest, 1 + (1 + x) * (std::sqrt(1 + x * x / 4) + x));
    }
    return largest;
}

double kick_of(const StringModel& model, std::span<const double> row) {
    double kick = 0;
    for (std::size_t k = 0; k < model.mode_count; ++k)
        kick += model.kinetic[k] * square(model.mobility[k] * row[k]);
    return std::sqrt(kick);
}

AlignedVector<double> shape_row(const StringModel& model, double x) {
    AlignedVector<double> row(model.stride, 0.0);
    for (std::size_t k = 0; k < model.mode_count; ++k) row[k] = mode_shape(k + 1, x, model.length_m);
    return row;
}

}  // namespace jawari::stress
