// Impulses of the last seconds by time and place, as an image whose first row is now.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stage/stage_link.h"
#include "window/model/theme.h"

namespace jawari::host::window {

inline constexpr std::size_t contactogram_rows = 90;
/// Time that a row stands for [s].
inline constexpr double contactogram_row_s = 1.0 / 30;

class Contactogram {
  public:
    Contactogram();

    void add(const Impact& impact);
    /// Time has passed: rows move down. True if the image is another one.
    bool advance(double seconds);
    void clear();

    /// Whether anything of it can be seen.
    [[nodiscard]] bool is_empty() const { return filled_ == 0; }
    /// Brightness at a row (0: now) and a column (0: the far end from the bridge), 0 to 1.
    [[nodiscard]] float at(std::size_t row, std::size_t column) const {
        return values_[row * impact_places + column];
    }
    /// RGBA, contactogram_rows x impact_places.
    [[nodiscard]] std::span<const std::uint8_t> image();

  private:
    std::vector<float> values_;
    std::vector<std::uint8_t> pixels_;
    std::size_t filled_ = 0;  ///< rows until nothing is left of what was added
    double passed_s_ = 0;
};

/// Brightness of an impulse, 0 to 1: the same ratio of impulses is the same step of brightness, from 1 uN s
/// (dark) to 3 mN s.
float impulse_brightness(float impulse_Ns);

}  // namespace jawari::host::window
