// Levels, load, quality level.
#pragma once

#include <array>
#include <string>

#include "window/view/panel.h"

namespace jawari::host::window {

class MetersPanel : public Panel {
  public:
    explicit MetersPanel(Shared& shared) : Panel(shared) {}

    void draw_still(Canvas& canvas) override;
    void draw_moving(Canvas& canvas) override;
    void follow(double passed_s) override;
    /// A new picture has come.
    void take(const StagePicture& picture);
    /// A press sets the worst load back.
    bool press(const Pointer& pointer) override;
    bool hover(const Pointer& pointer) override;

  private:
    std::array<float, 2> level_{};  ///< falls slowly, full scale is 1
    std::array<float, 2> held_{};   ///< peaks, held for a while
    float held_s_ = 0;
    float load_ = 0, worst_ = 0;  ///< as shown
    int quality_ = 0;
    bool clipped_ = false;
};

}  // namespace jawari::host::window
