// The strings as they move, over their frets; impacts; where the mouse plays.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "window/model/hand.h"
#include "window/model/string_places.h"
#include "window/view/panel.h"

namespace jawari::host::window {

class StringsPanel : public Panel {
  public:
    explicit StringsPanel(Shared& shared) : Panel(shared), hand_(shared.performance) {}
    ~StringsPanel() override { hand_.let_go(); }
    StringsPanel(const StringsPanel&) = delete;
    StringsPanel& operator=(const StringsPanel&) = delete;
    StringsPanel(StringsPanel&&) = delete;
    StringsPanel& operator=(StringsPanel&&) = delete;

    void place() override;
    void draw_still(Canvas& canvas) override;
    void draw_moving(Canvas& canvas) override;
    void follow(double passed_s) override;
    void take(const StagePicture& picture);
    void take(const Impact& impact);
    bool press(const Pointer& pointer) override;
    void drag(const Pointer& pointer) override;
    void release(const Pointer& pointer) override;
    bool hover(const Pointer& pointer) override;
    void leave() override;
    [[nodiscard]] std::size_t stops() const override { return shared_.setup ? 0 : 1; }
    /// Up and down choose a string, left and right a fret, Enter plucks, Delete mutes.
    bool key(const KeyPress& press) override;

    /// The description whose heights are drawn; null: the instrument's own.
    void show(const InstrumentDescription* description);
    /// The string that fills the picture, for the setup.
    void show_alone(std::optional<std::size_t> string);
    [[nodiscard]] const StringPlaces* places() const { return places_ ? &*places_ : nullptr; }

  private:
    /// A pull of the mouse at a string that it will let go.
    struct Pull {
        std::size_t string = 0;
        double from_bridge_m = 0;
        float x = 0, y = 0;  ///< of the pointer
        float began_y = 0;
    };
    struct Flash {
        std::size_t string = 0;
        double from_bridge_m = 0;
        float brightness = 0;  ///< 0 to 1, fades
    };
    /// What was drawn of a string some pictures ago.
    static constexpr std::size_t ghosts = 3;
    using Shape = std::array<float, shape_points>;
    struct Drawn {
        bool moves = false;
        std::size_t fret = 0;
        std::array<Shape, ghosts + 1> shapes{};  ///< the latest first
        std::size_t count = 0;                   ///< of them that are there
    };

    [[nodiscard]] bool shows(std::size_t string) const;
    void draw_lane(Canvas& canvas, std::size_t string);
    void draw_neck(Canvas& canvas, std::size_t string);
    void draw_obstacles(Canvas& canvas, std::size_t string);
    void draw_string(Canvas& canvas, std::size_t string);
    void draw_shape(Canvas& canvas, std::size_t string, const Shape& shape, std::size_t fret, float opacity);
    void draw_pull(Canvas& canvas, const Pull& pull);
    void draw_flash(Canvas& canvas, const Flash& flash);
    [[nodiscard]] double height_of(std::size_t string, double from_bridge_m) const;
    [[nodiscard]] float thickness(std::size_t string) const;
    [[nodiscard]] std::string string_name(std::size_t string) const;
    void let_go(const Pull& pull, double velocity);
    void describe(const StringHit& hit);

    Hand hand_;
    std::optional<StringPlaces> places_;
    std::shared_ptr<const LoadedInstrument> instrument_;
    std::optional<InstrumentDescription> description_;
    std::optional<std::size_t> alone_;
    std::vector<Drawn> drawn_;
    std::vector<Flash> flashes_;
    std::optional<Pull> pull_;
    bool muting_ = false;
    std::optional<StringHit> under_;  ///< the pointer
    std::size_t chosen_string_ = 0, chosen_fret_ = 0;
};

}  // namespace jawari::host::window
