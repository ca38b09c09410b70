#pragma once

namespace jawari {

constexpr double square(double x) {
    return x * x;
}

}  // namespace jawari
