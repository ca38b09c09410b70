// Drawing in the window's colours and units, on DPF's NanoVG.
#pragma once

#include <NanoVG.hpp>
#include <string>
#include <string_view>

#include "window/model/layout.h"
#include "window/model/theme.h"

namespace jawari::host::window {

enum class TextPlace { Left, Middle, Right };

/// For one frame at a time.
class Canvas {
  public:
    explicit Canvas(DGL_NAMESPACE::NanoVG& nanovg) : nanovg_(nanovg) {}

    [[nodiscard]] DGL_NAMESPACE::NanoVG& nanovg() const { return nanovg_; }

    void fill(Colour colour, float opacity = 1);
    void stroke(Colour colour, float width, float opacity = 1);
    void box(const Box& box, Colour colour, float radius = 0, float opacity = 1);
    void frame(const Box& box, Colour colour, float width = 1, float radius = 0, float opacity = 1);
    void segment(float x0, float y0, float x1, float y1, Colour colour, float width, float opacity = 1);
    void dot(float x, float y, float radius, Colour colour, float opacity = 1);

    [[nodiscard]] float text_width(std::string_view text, float size);
    /// On one line about the vertical middle of `box`; what does not fit is cut with an ellipsis. The width
    /// of what is drawn.
    float text(const Box& box, std::string_view text, float size, Colour colour,
               TextPlace place = TextPlace::Left);
    /// Broken into lines from the top of `box`, those that fit.
    void paragraph(const Box& box, std::string_view text, float size, Colour colour);

    /// Texts that were cut since the last call.
    [[nodiscard]] unsigned take_cut_texts();

  private:
    [[nodiscard]] std::string fitted(std::string_view text, float size, float width);

    DGL_NAMESPACE::NanoVG& nanovg_;
    unsigned cut_texts_ = 0;
};

}  // namespace jawari::host::window
