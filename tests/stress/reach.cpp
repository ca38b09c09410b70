#include "reach.h"

#include <algorithm>
#include <cmath>

#include "jawari/scene/modes.h"

namespace jawari::stress {
namespace {

double square(double x) {
    return x * x;
}

}  // namespace

double lag_of(const StringModel& model) {
    return model.shape->scheme == Scheme::Exact ? model.shape->step_s / 2 : 0.0;
}

Reach reach_of(const StringModel& model, std::span<const double> row) {
    const double lag = lag_of(model);
    double speed = 0, extent = 0, middle = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        if (row[k] == 0) continue;
        const double share = square(row[k]);
        speed += share / model.tuning.kinetic[k];
        middle += share / model.tuning.potential[k];
        extent += share * (1 / model.tuning.potential[k] + square(lag) / model.tuning.kinetic[k]);
    }
    return {std::sqrt(speed), std::sqrt(extent), std::sqrt(middle)};
}

double bound_of(double reach, double energy_J) {
    if (reach == 0) return 0;
    return std::isfinite(reach) ? reach * std::sqrt(energy_J) : reach;
}

double rounding_share(const StringModel& model) {
    double largest = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        const double x = model.shape->step_s * std::sqrt(model.tuning.potential[k] / model.tuning.kinetic[k]);
        largest = std::max(largest, 1 + (1 + x) * (std::sqrt(1 + x * x / 4) + x));
    }
    return largest;
}

double kick_of(const StringModel& model, std::span<const double> row) {
    double kick = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k)
        kick += model.tuning.kinetic[k] * square(model.shape->mobility[k] * row[k]);
    return std::sqrt(kick);
}

AlignedVector<double> shape_row(const StringModel& model, double x) {
    AlignedVector<double> row(model.shape->stride, 0.0);
    for (std::size_t k = 0; k < model.shape->mode_count - model.shape->hammer_count; ++k)
        row[k] = mode_shape(k + 1, x, model.shape->length_m);
    return row;
}

}  // namespace jawari::stress
