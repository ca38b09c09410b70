// How often a window is drawn: at most sixty times a second, and so rarely that drawing takes at most a fifth
// of a core.
#pragma once

#include <algorithm>

namespace jawari::host::window {

inline constexpr double shortest_frame_s = 1.0 / 60;
inline constexpr double longest_frame_s = 2;
inline constexpr double drawing_share = 0.2;

class Pacer {
  public:
    [[nodiscard]] bool is_due(double now_s) const { return now_s >= next_s_; }

    /// A frame was drawn at `now_s` and took that much of the processor [s].
    void drawn(double now_s, double cost_s) {
        // Rising costs count at once, falling ones slowly: no burst above the share.
        cost_s_ = cost_s > cost_s_ ? cost_s : cost_s_ + 0.2 * (cost_s - cost_s_);
        next_s_ = now_s + interval_s();
    }

    [[nodiscard]] double interval_s() const {
        return std::clamp(cost_s_ / drawing_share, shortest_frame_s, longest_frame_s);
    }

  private:
    double cost_s_ = 0;
    double next_s_ = 0;
};

}  // namespace jawari::host::window
