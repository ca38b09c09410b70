#include "window/view/surface.h"

#include <OpenGL-include.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>
#include <optional>
#include <utility>

#include "base/cpu_clock.h"

namespace jawari::host::window {

namespace {

/// Of all threads of the process [s].
double process_cpu_s() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double wall_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool is_software(const char* renderer) {
    if (renderer == nullptr) return false;
    for (const char* name : {"llvmpipe", "softpipe", "swrast", "Software"})
        if (std::strstr(renderer, name) != nullptr) return true;
    return false;
}

std::optional<KeyName> key_name(unsigned key) {
    switch (key) {
        case DGL_NAMESPACE::kKeyLeft:
            return KeyName::Left;
        case DGL_NAMESPACE::kKeyRight:
            return KeyName::Right;
        case DGL_NAMESPACE::kKeyUp:
            return KeyName::Up;
        case DGL_NAMESPACE::kKeyDown:
            return KeyName::Down;
        case DGL_NAMESPACE::kKeyPageUp:
            return KeyName::PageUp;
        case DGL_NAMESPACE::kKeyPageDown:
            return KeyName::PageDown;
        case DGL_NAMESPACE::kKeyHome:
            return KeyName::Home;
        case DGL_NAMESPACE::kKeyEnd:
            return KeyName::End;
        case '\r':
        case '\n':
            return KeyName::Enter;
        case DGL_NAMESPACE::kKeyBackspace:
        case DGL_NAMESPACE::kKeyDelete:
            return KeyName::Delete;
        case DGL_NAMESPACE::kKeyEscape:
            return KeyName::Escape;
        default:
            return std::nullopt;
    }
}

}  // namespace

Surface::Surface(DGL_NAMESPACE::Window& window, MainView& view, double scale,
                 std::function<void(const KeyEventFacts&)> foreign_key)
    : TopLevelWidget(window), view_(view), scale_(scale), foreign_key_(std::move(foreign_key)) {
    nanovg_.loadSharedResources();
    view_.resize(static_cast<float>(getWidth() / scale_), static_cast<float>(getHeight() / scale_));
}

Surface::~Surface() {
    if (texture_ != 0) glDeleteTextures(1, &texture_);
}

// ---------------------------------------------------------------------------------------------- drawing

void Surface::idle(double now_s) {
    view_.follow(now_s);
    const bool changed = view_.still_changed() || view_.moving_changed();
    if (changed && pacer_.is_due(now_s)) repaint();
}

void Surface::onDisplay() {
    const double began_s = wall_s();
    const double cpu_s = thread_cpu_s();
    const double all_s = process_cpu_s();
    if (!knows_renderer_) {
        in_software_ = is_software(reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
        knows_renderer_ = true;
    }
    const bool fits = texture_ != 0 && texture_width_ == getWidth() && texture_height_ == getHeight();
    if (view_.still_changed() || !fits) {
        draw_still();
        copy_still();
    } else {
        paste_still();
    }
    draw_moving();
    double cost_s = thread_cpu_s() - cpu_s;
    if (in_software_) {
        // Its threads have no clock of ours. Who else works meanwhile counts too, which errs on the safe
        // side.
        glFinish();
        cost_s = std::max(cost_s, process_cpu_s() - all_s);
    }
    counts_.drawn += 1;
    counts_.drawing_s += cost_s;
    pacer_.drawn(began_s, cost_s);
}

void Surface::draw_still() {
    nanovg_.beginFrame(getWidth(), getHeight());
    nanovg_.scale(static_cast<float>(scale_), static_cast<float>(scale_));
    nanovg_.fontFace(NANOVG_DEJAVU_SANS_TTF);
    Canvas canvas(nanovg_);
    view_.draw_still(canvas);
    nanovg_.endFrame();
}

void Surface::draw_moving() {
    nanovg_.beginFrame(getWidth(), getHeight());
    nanovg_.scale(static_cast<float>(scale_), static_cast<float>(scale_));
    nanovg_.fontFace(NANOVG_DEJAVU_SANS_TTF);
    Canvas canvas(nanovg_);
    view_.draw_moving(canvas);
    nanovg_.endFrame();
}

void Surface::copy_still() {
    if (texture_ == 0) {
        glGenTextures(1, &texture_);
        glBindTexture(GL_TEXTURE_2D, texture_);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    texture_width_ = getWidth();
    texture_height_ = getHeight();
    glBindTexture(GL_TEXTURE_2D, texture_);
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, static_cast<GLsizei>(texture_width_),
                     static_cast<GLsizei>(texture_height_), 0);
    glBindTexture(GL_TEXTURE_2D, 0);
}

void Surface::paste_still() {
    glMatrixMode(GL_PROJECTION);
    glPushMatrix();
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
    glPushMatrix();
    glLoadIdentity();
    glDisable(GL_BLEND);
    glEnable(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    glBegin(GL_QUADS);
    for (const auto& [x, y] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
        glTexCoord2i(x, y);
        glVertex2i(2 * x - 1, 2 * y - 1);
    }
    glEnd();
    glBindTexture(GL_TEXTURE_2D, 0);
    glDisable(GL_TEXTURE_2D);
    glEnable(GL_BLEND);
    glPopMatrix();
    glMatrixMode(GL_PROJECTION);
    glPopMatrix();
    glMatrixMode(GL_MODELVIEW);
}

void Surface::onResize(const ResizeEvent& event) {
    TopLevelWidget::onResize(event);
    view_.resize(static_cast<float>(event.size.getWidth() / scale_),
                 static_cast<float>(event.size.getHeight() / scale_));
}

// ---------------------------------------------------------------------------------------------- events

Pointer Surface::pointer_at(double x, double y, unsigned modifiers) const {
    Pointer pointer;
    pointer.x = static_cast<float>(x / scale_);
    pointer.y = static_cast<float>(y / scale_);
    pointer.button = button_;
    pointer.shift = (modifiers & DGL_NAMESPACE::kModifierShift) != 0;
    return pointer;
}

bool Surface::onMouse(const MouseEvent& event) {
    if (event.press) {
        if (button_ != 0) return true;
        button_ = event.button;
        view_.press(pointer_at(event.pos.getX(), event.pos.getY(), event.mod));
        if (view_.types()) getWindow().focus();
    } else if (event.button == button_) {
        view_.release(pointer_at(event.pos.getX(), event.pos.getY(), event.mod));
        button_ = 0;
    }
    return true;
}

bool Surface::onMotion(const MotionEvent& event) {
    view_.move(pointer_at(event.pos.getX(), event.pos.getY(), event.mod));
    return true;
}

bool Surface::onScroll(const ScrollEvent& event) {
    const auto lines = static_cast<float>(event.delta.getY());
    if (lines != 0) view_.scroll(pointer_at(event.pos.getX(), event.pos.getY(), event.mod), lines);
    return true;
}

bool Surface::use_key(const KeyboardEvent& event) {
    const bool shift = (event.mod & DGL_NAMESPACE::kModifierShift) != 0;
    const bool others = (event.mod & (DGL_NAMESPACE::kModifierControl | DGL_NAMESPACE::kModifierAlt |
                                      DGL_NAMESPACE::kModifierSuper)) != 0;
    if (others) return false;
    if (event.key == '\t') return !event.press || view_.tab(shift);
    if (const auto name = key_name(event.key)) {
        if (view_.types()) return !event.press || view_.key({*name, shift}) || *name == KeyName::Delete;
        return event.press && view_.key({*name, shift});
    }
    // What is being typed comes as characters.
    return view_.types();
}

bool Surface::onKeyboard(const KeyboardEvent& event) {
    if (use_key(event)) return true;
    KeyEventFacts facts;
    facts.press = event.press;
    facts.keycode = event.keycode;
    facts.shift = (event.mod & DGL_NAMESPACE::kModifierShift) != 0;
    facts.control = (event.mod & DGL_NAMESPACE::kModifierControl) != 0;
    facts.alt = (event.mod & DGL_NAMESPACE::kModifierAlt) != 0;
    foreign_key_(facts);
    return false;
}

bool Surface::onCharacterInput(const CharacterInputEvent& event) {
    const bool others = (event.mod & (DGL_NAMESPACE::kModifierControl | DGL_NAMESPACE::kModifierAlt)) != 0;
    return !others && view_.character(event.character, event.string);
}

}  // namespace jawari::host::window
