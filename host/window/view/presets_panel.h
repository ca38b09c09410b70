// The presets, with search; the name and the description of the one that plays.
#pragma once

#include <string>
#include <vector>

#include "window/model/preset_search.h"
#include "window/view/panel.h"

namespace jawari::host::window {

class PresetsPanel : public Panel {
  public:
    explicit PresetsPanel(Shared& shared);

    void draw_still(Canvas& canvas) override;
    /// Over everything else, if the list has no place of its own.
    void draw_over(Canvas& canvas);
    void follow(double passed_s) override;
    bool press(const Pointer& pointer) override;
    bool hover(const Pointer& pointer) override;
    void leave() override;
    bool scroll(const Pointer& pointer, float lines) override;
    /// Search, list.
    [[nodiscard]] std::size_t stops() const override { return is_shown() ? 2 : 0; }
    bool key(const KeyPress& press) override;
    bool character(std::uint32_t character, const char* text) override;

    /// Whether it takes the pointer there before anything that lies below it.
    [[nodiscard]] bool covers(const Pointer& pointer) const;

    static constexpr std::size_t search_stop = 0;

  private:
    static constexpr std::size_t list_stop = 1;

    [[nodiscard]] bool is_shown() const { return shared_.layout.wide || shared_.presets_open; }
    [[nodiscard]] std::size_t visible_rows() const;
    void find();
    void choose(std::size_t row);
    void show_row(std::size_t row);
    void draw_head(Canvas& canvas);
    void draw_list(Canvas& canvas);
    void draw_row(Canvas& canvas, const Box& box, std::size_t row);
    bool type_key(const KeyPress& press);

    std::vector<ListedPreset> presets_;
    std::string query_;
    std::vector<std::size_t> found_;
    std::size_t first_ = 0;   ///< row on top of the list
    std::size_t marked_ = 0;  ///< row that keys choose
    std::size_t under_ = no_stop;
    unsigned version_;
    bool compiling_ = false;
};

}  // namespace jawari::host::window
