// Random numbers that are the same with every compiler and library, so that a seed names a scene for good.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace jawari::stress {

/// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
        return z ^ (z >> 31);
    }

    /// 0 to 1, 1 excluded.
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * unit(); }
    /// Uniform in the logarithm.
    double spread(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    /// low to high, both included.
    std::size_t whole(std::size_t low, std::size_t high) {
        return low + static_cast<std::size_t>(bits() % (high - low + 1));
    }
    std::size_t spread_whole(std::size_t low, std::size_t high) {
        const double value = spread(static_cast<double>(low), static_cast<double>(high) + 1);
        return std::min(high, static_cast<std::size_t>(value));
    }
    bool chance(double probability) { return unit() < probability; }
    double pick(std::initializer_list<double> values) { return values.begin()[whole(0, values.size() - 1)]; }

  private:
    std::uint64_t state_;
};

}  // namespace jawari::stress
