#include "window/view/main_view.h"

#include <algorithm>
#include <cmath>

namespace jawari::host::window {

using theme::grid;

namespace {

constexpr double notice_s = 6;
constexpr double twice_s = 0.4;
constexpr float twice_reach = 4;
/// A window that was hidden does not replay what it missed.
constexpr double longest_step_s = 0.5;

}  // namespace

MainView::MainView(Performance& performance)
    : shared_(performance, lay_out(usual_width, usual_height)),
      presets_(shared_),
      meters_(shared_),
      strings_(shared_),
      setup_(shared_, strings_),
      keyboard_(shared_),
      parameters_(shared_) {
    follow_preset();
}

void MainView::resize(float width, float height) {
    shared_.layout = lay_out(width, height);
    for (Panel* panel : panels_) panel->place();
    strings_.place();
    setup_.place();
    shared_.still_changed = true;
}

// ---------------------------------------------------------------------------------------------- news

void MainView::follow_preset() {
    const PresetInForce& preset = shared_.performance.preset();
    if (preset.version == version_ && preset.instrument == instrument_) return;
    version_ = preset.version;
    instrument_ = preset.instrument;
    strings_.place();
    setup_.place();
    keyboard_.place();
    shared_.still_changed = true;
}

void MainView::follow_notices() {
    while (const auto notice = shared_.performance.notice()) {
        notice_ = *notice;
        notice_until_s_ = shared_.now_s + notice_s;
        shared_.still_changed = true;
    }
    if (!notice_.empty() && shared_.now_s > notice_until_s_) {
        notice_.clear();
        shared_.still_changed = true;
    }
}

void MainView::follow(double now_s) {
    const double passed_s = last_s_ < 0 ? 0 : std::min(now_s - last_s_, longest_step_s);
    last_s_ = now_s;
    shared_.now_s = now_s;
    follow_preset();
    follow_notices();
    if (const StagePicture* picture = shared_.performance.link().picture()) {
        shared_.picture = picture;
        strings_.take(*picture);
        keyboard_.take(*picture);
        meters_.take(*picture);
    }
    if (contactogram_.advance(passed_s)) contactogram_changed_ = true;
    Impact impact;
    while (shared_.performance.link().next_impact(impact)) {
        contactogram_.add(impact);
        strings_.take(impact);
        contactogram_changed_ = true;
    }
    if (contactogram_changed_) shared_.moving_changed = true;
    for (Panel* panel : panels_) panel->follow(passed_s);
}

// ---------------------------------------------------------------------------------------------- drawing

void MainView::draw_still(Canvas& canvas) {
    shared_.still_changed = false;
    const Layout& layout = shared_.layout;
    canvas.box({0, 0, layout.width, layout.height}, theme::ground);
    for (Panel* panel : panels_)
        if (panel != &setup_) panel->draw_still(canvas);
    setup_.draw_still(canvas);
    draw_tabs(canvas);
    draw_contactogram_frame(canvas);
}

void MainView::draw_moving(Canvas& canvas) {
    shared_.moving_changed = false;
    draw_contactogram(canvas);
    for (Panel* panel : panels_) panel->draw_moving(canvas);
    presets_.draw_over(canvas);
}

void MainView::draw_tabs(Canvas& canvas) {
    const Layout& layout = shared_.layout;
    const auto tab = [&](const Box& box, const char* name, bool chosen) {
        const Box inside{box.x + 1, box.y + 1, box.width - 2, box.height - 2};
        canvas.box(inside, chosen ? theme::accent : theme::raised, 4);
        canvas.text(inside, name, theme::type, chosen ? theme::ground : theme::text, TextPlace::Middle);
    };
    tab(layout.play_tab, "Play", !shared_.setup);
    tab(layout.setup_tab, "Setup", shared_.setup);
    if (!notice_.empty())
        canvas.text(layout.notice, notice_, theme::small_type,
                    notice_.starts_with("warning") ? theme::impact : theme::text);
    else
        canvas.text(layout.notice, shared_.hint, theme::small_type, theme::quiet);
}

void MainView::draw_contactogram_frame(Canvas& canvas) {
    const Box& box = shared_.layout.contactogram;
    canvas.text({box.x, box.y, 36, 14}, "now", theme::small_type, theme::quiet);
    canvas.text({box.x, box.bottom() - 14, 36, 14}, "-3 s", theme::small_type, theme::quiet);
}

/// Its columns lie under the places of the strings at which the impulses act.
void MainView::draw_contactogram(Canvas& canvas) {
    const StringPlaces* const places = strings_.places();
    const Box& box = shared_.layout.contactogram;
    if (places == nullptr) return;
    auto& nanovg = canvas.nanovg();
    if (contactogram_changed_ || image_ == nullptr) {
        contactogram_changed_ = !contactogram_.is_empty();
        const auto pixels = contactogram_.image();
        image_ = std::make_unique<DGL_NAMESPACE::NanoImage>(
            nanovg.createImageFromRGBA(static_cast<unsigned>(impact_places),
                                       static_cast<unsigned>(contactogram_rows), pixels.data(), 0));
    }
    double longest_m = 0;
    for (const StringLane& lane : places->lanes()) longest_m = std::max(longest_m, lane.length_m);
    const float left = places->x_of(longest_m);
    const float right = places->x_of(0);
    const Box area{left, box.y, right - left, box.height};
    nanovg.beginPath();
    nanovg.rect(area.x, area.y, area.width, area.height);
    nanovg.fillPaint(nanovg.imagePattern(area.x, area.y, area.width, area.height, 0, *image_, 1));
    nanovg.fill();
    canvas.frame(area, theme::line);
}

// ---------------------------------------------------------------------------------------------- mouse

bool MainView::press_tabs(const Pointer& pointer) {
    const bool play = shared_.layout.play_tab.has(pointer.x, pointer.y);
    const bool setup = shared_.layout.setup_tab.has(pointer.x, pointer.y);
    if (!play && !setup) return false;
    setup_.open(setup);
    shared_.still_changed = true;
    return true;
}

void MainView::press(Pointer pointer) {
    if (grabbed_ != nullptr) return;
    shared_.focus_shown = false;
    pointer.twice = shared_.now_s - press_s_ < twice_s && std::abs(pointer.x - press_x_) < twice_reach &&
                    std::abs(pointer.y - press_y_) < twice_reach;
    press_s_ = pointer.twice ? -1 : shared_.now_s;
    press_x_ = pointer.x;
    press_y_ = pointer.y;
    for (Panel* panel : panels_) panel->set_focus(Panel::no_stop);
    shared_.still_changed = true;
    if (presets_.press(pointer)) {
        grabbed_ = &presets_;
        return;
    }
    if (press_tabs(pointer)) return;
    for (Panel* panel : panels_) {
        if (panel == &presets_ || !panel->press(pointer)) continue;
        grabbed_ = panel;
        return;
    }
}

void MainView::move(const Pointer& pointer) {
    if (grabbed_ != nullptr) {
        grabbed_->drag(pointer);
        return;
    }
    bool found = false;
    for (Panel* panel : panels_) {
        if (!found && panel->hover(pointer))
            found = true;
        else
            panel->leave();
    }
    if (!found) shared_.say("");
}

void MainView::release(const Pointer& pointer) {
    if (grabbed_ == nullptr) return;
    grabbed_->release(pointer);
    grabbed_ = nullptr;
}

void MainView::scroll(const Pointer& pointer, float lines) {
    for (Panel* panel : panels_)
        if (panel->scroll(pointer, lines)) return;
}

void MainView::leave() {
    if (grabbed_ != nullptr) return;
    for (Panel* panel : panels_) panel->leave();
    shared_.say("");
}

// ---------------------------------------------------------------------------------------------- keys

Panel* MainView::focused() const {
    for (Panel* panel : panels_)
        if (panel->focus() != Panel::no_stop) return panel;
    return nullptr;
}

void MainView::focus_on(Panel* panel, std::size_t stop) {
    for (Panel* other : panels_) other->set_focus(Panel::no_stop);
    panel->set_focus(stop);
    shared_.focus_shown = true;
    shared_.still_changed = true;
    shared_.moving_changed = true;
}

bool MainView::tab(bool backwards) {
    struct Stop {
        Panel* panel;
        std::size_t stop;
    };
    std::vector<Stop> stops;
    std::optional<std::size_t> now;
    for (Panel* panel : panels_) {
        for (std::size_t stop = 0; stop < panel->stops(); ++stop) {
            if (panel->focus() == stop) now = stops.size();
            stops.push_back({panel, stop});
        }
    }
    if (stops.empty()) return false;
    std::size_t next = backwards ? stops.size() - 1 : 0;
    if (now) next = (*now + (backwards ? stops.size() - 1 : 1)) % stops.size();
    focus_on(stops[next].panel, stops[next].stop);
    return true;
}

bool MainView::key(const KeyPress& press) {
    Panel* const panel = focused();
    if (panel != nullptr && panel->key(press)) {
        shared_.focus_shown = true;
        shared_.still_changed = true;
        return true;
    }
    if (press.key == KeyName::Escape && (panel != nullptr || shared_.presets_open)) {
        for (Panel* other : panels_) other->set_focus(Panel::no_stop);
        shared_.presets_open = false;
        shared_.still_changed = true;
        return true;
    }
    return false;
}

bool MainView::character(std::uint32_t character, const char* text) {
    Panel* const panel = focused();
    return panel != nullptr && panel->character(character, text);
}

}  // namespace jawari::host::window
