#include "window/view/canvas.h"

#include <algorithm>

namespace jawari::host::window {

namespace {

using DGL_NAMESPACE::Color;
using DGL_NAMESPACE::NanoVG;

Color colour_of(Colour colour, float opacity) {
    return {static_cast<int>(colour.red), static_cast<int>(colour.green), static_cast<int>(colour.blue),
            opacity};
}

constexpr float line_height = 1.4F;

}  // namespace

void Canvas::fill(Colour colour, float opacity) {
    nanovg_.fillColor(colour_of(colour, opacity));
    nanovg_.fill();
}

void Canvas::stroke(Colour colour, float width, float opacity) {
    nanovg_.strokeColor(colour_of(colour, opacity));
    nanovg_.strokeWidth(width);
    nanovg_.stroke();
}

void Canvas::box(const Box& box, Colour colour, float radius, float opacity) {
    nanovg_.beginPath();
    if (radius > 0)
        nanovg_.roundedRect(box.x, box.y, box.width, box.height, radius);
    else
        nanovg_.rect(box.x, box.y, box.width, box.height);
    fill(colour, opacity);
}

void Canvas::frame(const Box& box, Colour colour, float width, float radius, float opacity) {
    nanovg_.beginPath();
    nanovg_.roundedRect(box.x + width / 2, box.y + width / 2, box.width - width, box.height - width, radius);
    stroke(colour, width, opacity);
}

void Canvas::segment(float x0, float y0, float x1, float y1, Colour colour, float width, float opacity) {
    nanovg_.beginPath();
    nanovg_.moveTo(x0, y0);
    nanovg_.lineTo(x1, y1);
    stroke(colour, width, opacity);
}

void Canvas::dot(float x, float y, float radius, Colour colour, float opacity) {
    nanovg_.beginPath();
    nanovg_.circle(x, y, radius);
    fill(colour, opacity);
}

float Canvas::text_width(std::string_view text, float size) {
    if (text.empty()) return 0;
    nanovg_.fontSize(size);
    nanovg_.textAlign(NanoVG::ALIGN_LEFT | NanoVG::ALIGN_MIDDLE);
    DGL_NAMESPACE::Rectangle<float> bounds;
    return nanovg_.textBounds(0, 0, text.data(), text.data() + text.size(), bounds);
}

std::string Canvas::fitted(std::string_view text, float size, float width) {
    if (text_width(text, size) <= width) return std::string(text);
    cut_texts_ += 1;
    std::string cut(text);
    while (!cut.empty()) {
        do cut.pop_back();
        while (!cut.empty() && (static_cast<unsigned char>(cut.back()) & 0xC0U) == 0x80U);
        if (text_width(cut + "…", size) <= width) return cut + "…";
    }
    return cut;
}

float Canvas::text(const Box& box, std::string_view text, float size, Colour colour, TextPlace place) {
    const std::string shown = fitted(text, size, box.width);
    if (shown.empty()) return 0;
    float x = box.x;
    int align = NanoVG::ALIGN_LEFT;
    if (place == TextPlace::Middle) {
        x = box.middle_x();
        align = NanoVG::ALIGN_CENTER;
    } else if (place == TextPlace::Right) {
        x = box.right();
        align = NanoVG::ALIGN_RIGHT;
    }
    nanovg_.fontSize(size);
    nanovg_.textAlign(align | NanoVG::ALIGN_MIDDLE);
    nanovg_.fillColor(colour_of(colour, 1));
    nanovg_.text(x, box.middle_y(), shown.data(), shown.data() + shown.size());
    return text_width(shown, size);
}

void Canvas::paragraph(const Box& box, std::string_view text, float size, Colour colour) {
    const auto lines = static_cast<std::size_t>(box.height / (size * line_height));
    Box row{box.x, box.y, box.width, size * line_height};
    std::string line;
    std::size_t begin = 0;
    for (std::size_t n = 0; n < lines && begin < text.size(); ++n) {
        if (n + 1 == lines) {
            this->text(row, text.substr(begin), size, colour);
            return;
        }
        line.clear();
        while (begin < text.size()) {
            const std::size_t end = std::min(text.find(' ', begin), text.size());
            const std::string longer =
                line + (line.empty() ? "" : " ") + std::string(text.substr(begin, end - begin));
            if (!line.empty() && text_width(longer, size) > box.width) break;
            line = longer;
            begin = std::min(end + 1, text.size());
        }
        this->text(row, line, size, colour);
        row.y += row.height;
    }
}

unsigned Canvas::take_cut_texts() {
    const unsigned cut = cut_texts_;
    cut_texts_ = 0;
    return cut;
}

}  // namespace jawari::host::window
