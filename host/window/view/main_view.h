// The whole window: panels, who of them has the mouse and the keys, and what is drawn when.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "window/model/contactogram.h"
#include "window/view/keyboard_panel.h"
#include "window/view/meters_panel.h"
#include "window/view/parameters_panel.h"
#include "window/view/presets_panel.h"
#include "window/view/setup_panel.h"
#include "window/view/strings_panel.h"

namespace jawari::host::window {

class MainView {
  public:
    explicit MainView(Performance& performance);

    /// In units of the layout.
    void resize(float width, float height);
    /// Takes what has come from the stage. To be called often, however rarely it is drawn.
    void follow(double now_s);

    [[nodiscard]] bool still_changed() const { return shared_.still_changed; }
    [[nodiscard]] bool moving_changed() const { return shared_.moving_changed; }
    void draw_still(Canvas& canvas);
    void draw_moving(Canvas& canvas);

    void press(Pointer pointer);
    void move(const Pointer& pointer);
    void release(const Pointer& pointer);
    void scroll(const Pointer& pointer, float lines);
    void leave();
    /// False: the window does not use the key, which belongs to its host.
    bool key(const KeyPress& press);
    bool tab(bool backwards);
    bool character(std::uint32_t character, const char* text);
    /// Text is being typed: every key is the window's.
    [[nodiscard]] bool types() const { return presets_.focus() == PresetsPanel::search_stop; }

    /// Before the drawing context ends.
    void forget_images() { image_.reset(); }

  private:
    [[nodiscard]] bool press_tabs(const Pointer& pointer);
    void follow_preset();
    void follow_notices();
    void focus_on(Panel* panel, std::size_t stop);
    [[nodiscard]] Panel* focused() const;
    void draw_tabs(Canvas& canvas);
    void draw_contactogram_frame(Canvas& canvas);
    void draw_contactogram(Canvas& canvas);

    Shared shared_;
    PresetsPanel presets_;
    MetersPanel meters_;
    StringsPanel strings_;
    SetupPanel setup_;
    KeyboardPanel keyboard_;
    ParametersPanel parameters_;
    /// In the order of the Tab key.
    std::array<Panel*, 6> panels_{&presets_, &meters_, &setup_, &strings_, &keyboard_, &parameters_};
    Panel* grabbed_ = nullptr;  ///< has the mouse until its button is let go

    Contactogram contactogram_;
    bool contactogram_changed_ = true;
    std::unique_ptr<DGL_NAMESPACE::NanoImage> image_;  ///< of the contactogram
    unsigned version_ = 0;
    SharedInstrument instrument_;
    std::string notice_;
    double notice_until_s_ = 0;
    double last_s_ = -1;
    float press_x_ = 0, press_y_ = 0;
    double press_s_ = -1;
};

}  // namespace jawari::host::window
