// The tab "Setup": one string large, and everything of the instrument that can be dragged on it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "window/model/preset_edit.h"
#include "window/view/strings_panel.h"

namespace jawari::host::window {

class SetupPanel : public Panel {
  public:
    SetupPanel(Shared& shared, StringsPanel& strings) : Panel(shared), strings_(strings) {}

    /// The tab is chosen, or no longer.
    void open(bool on);

    void place() override;
    void draw_still(Canvas& canvas) override;
    void draw_moving(Canvas& canvas) override;
    void follow(double passed_s) override;
    bool press(const Pointer& pointer) override;
    void drag(const Pointer& pointer) override;
    void release(const Pointer& pointer) override;
    bool hover(const Pointer& pointer) override;
    bool scroll(const Pointer& pointer, float lines) override;
    [[nodiscard]] std::size_t stops() const override { return shared_.setup ? handles_.size() : 0; }
    bool key(const KeyPress& press) override;

  private:
    struct Hold {
        PartName name;
        std::string text;                  ///< of the preset when it was taken hold of
        InstrumentDescription instrument;  ///< likewise
        Move begun;
        float x = 0, y = 0;
    };

    void choose_string(std::size_t string);
    [[nodiscard]] std::vector<double> fret_places() const;
    [[nodiscard]] double length_m() const;
    void find_handles();
    [[nodiscard]] Box box_of(const Handle& handle) const;
    [[nodiscard]] std::optional<std::size_t> at(const Pointer& pointer) const;
    [[nodiscard]] std::string label_of(const Handle& handle) const;
    void hold(std::size_t handle, const Pointer& pointer);
    void move_to(const Move& move);
    void send();

    StringsPanel& strings_;
    std::size_t string_ = 0;
    std::optional<Preset> edited_;  ///< as it is drawn, if it is not the one that plays
    std::string text_;              ///< of edited_
    bool unsent_ = false;
    bool sent_ = false;     ///< and not in force yet
    unsigned version_ = 0;  ///< of the preset that plays
    std::vector<Handle> handles_;
    std::optional<Hold> hold_;
    std::optional<std::size_t> under_;
};

}  // namespace jawari::host::window
