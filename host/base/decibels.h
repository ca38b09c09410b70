// Levels.
#pragma once

#include <cmath>

namespace jawari::host {

/// 20 dB are a factor of ten.
inline double factor_of(double decibels) {
    return std::pow(10.0, decibels / 20);
}

}  // namespace jawari::host
