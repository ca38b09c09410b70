// A keyboard that shows and plays notes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "window/model/keyboard.h"
#include "window/view/panel.h"

namespace jawari::host::window {

class KeyboardPanel : public Panel {
  public:
    explicit KeyboardPanel(Shared& shared) : Panel(shared) {}

    void place() override;
    void draw_still(Canvas& canvas) override;
    void take(const StagePicture& picture);
    bool press(const Pointer& pointer) override;
    void drag(const Pointer& pointer) override;
    void release(const Pointer& pointer) override;
    bool hover(const Pointer& pointer) override;
    [[nodiscard]] std::size_t stops() const override { return 1; }
    /// Left and right choose a key, Enter plays it until another key is pressed.
    bool key(const KeyPress& press) override;

  private:
    void play(int key, double velocity);
    void let_go();

    std::vector<PianoKey> keys_;
    std::array<bool, 128> sounds_{};  ///< held notes
    std::array<bool, 128> has_{};     ///< keys that some string has
    std::optional<int> down_;         ///< by the mouse or Enter
    int chosen_ = 60;                 ///< by arrow keys
};

}  // namespace jawari::host::window
