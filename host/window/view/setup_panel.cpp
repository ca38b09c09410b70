#include "window/view/setup_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "window/model/note_names.h"

namespace jawari::host::window {

using theme::grid;

namespace {

constexpr float handle_size = 12;

bool is_neck(Part part) {
    return part == Part::Action || part == Part::Relief;
}

}  // namespace

void SetupPanel::open(bool on) {
    shared_.setup = on;
    strings_.show_alone(on ? std::optional(string_) : std::nullopt);
    find_handles();
}

void SetupPanel::choose_string(std::size_t string) {
    string_ = string;
    strings_.show_alone(string_);
    find_handles();
}

void SetupPanel::place() {
    const auto& instrument = shared_.performance.preset().instrument;
    if (instrument != nullptr) string_ = std::min(string_, instrument->model.strings.size() - 1);
    find_handles();
}

/// What was edited is in force, or another preset is.
void SetupPanel::follow(double /*passed_s*/) {
    const PresetInForce& preset = shared_.performance.preset();
    const bool compiling = shared_.performance.facts().compiling;
    const bool refused = sent_ && !compiling && preset.version == version_;
    if (refused) {
        // A notice says why; what plays is drawn again.
        sent_ = false;
        edited_.reset();
        strings_.show(nullptr);
        find_handles();
    }
    if (unsent_ && !compiling) send();
    if (preset.version == version_) return;
    version_ = preset.version;
    const bool is_ours = sent_ && preset.edited;
    if (!is_ours) hold_.reset();
    if (hold_ || unsent_) return;
    sent_ = false;
    edited_.reset();
    strings_.show(nullptr);
    find_handles();
}

void SetupPanel::send() {
    unsent_ = false;
    sent_ = true;
    shared_.performance.edit_preset(text_);
}

std::vector<double> SetupPanel::fret_places() const {
    std::vector<double> places;
    for (const FretPlace& fret : strings_.places()->lanes()[string_].frets)
        places.push_back(fret.from_bridge_m);
    return places;
}

double SetupPanel::length_m() const {
    return strings_.places()->lanes()[string_].length_m;
}

void SetupPanel::find_handles() {
    handles_.clear();
    under_.reset();
    const auto& instrument = shared_.performance.preset().instrument;
    if (!shared_.setup || strings_.places() == nullptr || instrument == nullptr) return;
    const InstrumentDescription& shown = edited_ ? edited_->instrument : instrument->preset.instrument;
    handles_ = handles_of(shown, string_, length_m(), fret_places());
}

// ---------------------------------------------------------------------------------------------- drawing

/// Where a handle is drawn. What moves along the string hangs above it; action and relief, below it.
Box SetupPanel::box_of(const Handle& handle) const {
    const StringPlaces& places = *strings_.places();
    const Box& area = shared_.layout.strings;
    PicturePoint at = places.point(string_, handle.from_bridge_m, handle.height_m);
    if (handle.name.part == Part::Exciter || handle.name.part == Part::Pickup)
        at.y = area.y + (handle.name.part == Part::Exciter ? 26.0F : 46.0F);
    if (is_neck(handle.name.part)) at.y = area.bottom() - 26;
    return {at.x - handle_size / 2, at.y - handle_size / 2, handle_size, handle_size};
}

std::string SetupPanel::label_of(const Handle& handle) const {
    std::array<char, 96> text{};
    if (is_neck(handle.name.part))
        std::snprintf(text.data(), text.size(), "%s: drag up or down", handle.label.c_str());
    else if (handle.along && handle.across)
        std::snprintf(text.data(), text.size(), "%s: %.1f mm long, top at %.2f mm", handle.label.c_str(),
                      1000 * handle.from_bridge_m, 1000 * handle.height_m);
    else if (handle.along)
        std::snprintf(text.data(), text.size(), "%s: %.1f mm from the bridge", handle.label.c_str(),
                      1000 * handle.from_bridge_m);
    else
        std::snprintf(text.data(), text.size(), "%s: %.3f mm", handle.label.c_str(), 1000 * handle.height_m);
    return text.data();
}

void SetupPanel::draw_still(Canvas& canvas) {
    if (!shared_.setup || strings_.places() == nullptr) return;
    const StringPlaces& places = *strings_.places();
    const Box& area = shared_.layout.strings;
    const std::string heading = "String " + std::to_string(string_ + 1) + " of " +
                                std::to_string(places.lanes().size()) + " · scroll for another";
    canvas.text({area.x, area.y + 2, area.width - grid, 16}, heading, theme::small_type, theme::quiet,
                TextPlace::Right);
    for (std::size_t h = 0; h < handles_.size(); ++h) {
        const Handle& handle = handles_[h];
        const Box box = box_of(handle);
        const bool lit = under_ == h || (hold_ && hold_->name == handle.name);
        const float x = box.middle_x();
        if (handle.along && !handle.across)
            canvas.segment(x, box.bottom(), x, places.rest_y(string_) - 2, theme::accent, 1, 0.5F);
        const float size = handle.name.part == Part::Fret && !lit ? 3.5F : handle_size / 2;
        canvas.dot(x, box.middle_y(), size, lit ? theme::text : theme::accent);
        if (shows_focus(h)) draw_focus(canvas, box);
        const bool named = handle.name.part != Part::Fret && handle.name.part != Part::ObstacleCorner;
        if (named || lit)
            canvas.text({box.right() + 6, box.y - 3, 160, 18}, lit ? label_of(handle) : handle.label,
                        theme::small_type, lit ? theme::text : theme::accent);
    }
}

void SetupPanel::draw_moving(Canvas& /*canvas*/) {}

// ---------------------------------------------------------------------------------------------- dragging

std::optional<std::size_t> SetupPanel::at(const Pointer& pointer) const {
    std::optional<std::size_t> nearest;
    float least = handle_size;
    for (std::size_t h = 0; h < handles_.size(); ++h) {
        const Box box = box_of(handles_[h]);
        const float distance = std::hypot(pointer.x - box.middle_x(), pointer.y - box.middle_y());
        if (distance >= least) continue;
        least = distance;
        nearest = h;
    }
    return nearest;
}

void SetupPanel::hold(std::size_t handle, const Pointer& pointer) {
    const PresetInForce& preset = shared_.performance.preset();
    const Handle& held = handles_[handle];
    hold_ = Hold{held.name,
                 edited_ ? text_ : preset.text,
                 edited_ ? edited_->instrument : preset.instrument->preset.instrument,
                 {held.from_bridge_m, is_neck(held.name.part) ? 0.0 : held.height_m},
                 pointer.x,
                 pointer.y};
}

void SetupPanel::move_to(const Move& move) {
    const auto text = with_part_moved(hold_->text, hold_->instrument, string_, length_m(), fret_places(),
                                      hold_->name, move);
    if (!text) return;
    auto read = read_preset(*text, shared_.performance.preset().name);
    if (!read) return;
    text_ = *text;
    edited_ = std::move(read.value());
    unsent_ = true;
    strings_.show(&edited_->instrument);
    find_handles();
    for (const Handle& handle : handles_)
        if (handle.name == hold_->name) shared_.say(label_of(handle));
    shared_.still_changed = true;
}

bool SetupPanel::press(const Pointer& pointer) {
    if (!shared_.setup || pointer.button != 1 || strings_.places() == nullptr) return false;
    const auto handle = at(pointer);
    if (!handle) return false;
    set_focus(*handle);
    hold(*handle, pointer);
    shared_.still_changed = true;
    return true;
}

void SetupPanel::drag(const Pointer& pointer) {
    if (!hold_) return;
    const StringPlaces& places = *strings_.places();
    const float share = pointer.shift ? 0.1F : 1.0F;
    const double along_m = places.from_bridge_at(pointer.x) - places.from_bridge_at(hold_->x);
    const double across_m = static_cast<double>(hold_->y - pointer.y) / places.pixels_per_height_m();
    hold_->begun.from_bridge_m += along_m * static_cast<double>(share);
    hold_->begun.height_m += across_m * static_cast<double>(share);
    hold_->x = pointer.x;
    hold_->y = pointer.y;
    move_to(hold_->begun);
}

void SetupPanel::release(const Pointer& /*pointer*/) {
    hold_.reset();
    shared_.still_changed = true;
}

bool SetupPanel::hover(const Pointer& pointer) {
    if (!shared_.setup || strings_.places() == nullptr) return false;
    const auto before = under_;
    under_ = at(pointer);
    if (under_ != before) shared_.still_changed = true;
    if (under_) shared_.say(label_of(handles_[*under_]) + "; Shift: finer");
    return under_.has_value();
}

bool SetupPanel::scroll(const Pointer& pointer, float lines) {
    if (!shared_.setup || strings_.places() == nullptr || !shared_.layout.strings.has(pointer.x, pointer.y))
        return false;
    const std::size_t last = strings_.places()->lanes().size() - 1;
    choose_string(lines > 0 ? std::min(string_ + 1, last) : string_ - std::min<std::size_t>(string_, 1));
    return true;
}

/// Arrows move the handle that has the focus; page up and page down choose a string.
bool SetupPanel::key(const KeyPress& press) {
    if (!shared_.setup || focus() >= handles_.size()) return false;
    if (press.key == KeyName::PageUp || press.key == KeyName::PageDown) {
        const std::size_t last = strings_.places()->lanes().size() - 1;
        choose_string(press.key == KeyName::PageUp ? std::min(string_ + 1, last)
                                                   : string_ - std::min<std::size_t>(string_, 1));
        return true;
    }
    constexpr double along_m = 0.001;
    constexpr double across_m = 0.00002;
    const double share = press.shift ? 0.1 : 1.0;
    Move step;
    if (press.key == KeyName::Left) step.from_bridge_m = along_m * share;
    if (press.key == KeyName::Right) step.from_bridge_m = -along_m * share;
    if (press.key == KeyName::Up) step.height_m = across_m * share;
    if (press.key == KeyName::Down) step.height_m = -across_m * share;
    if (step.from_bridge_m == 0 && step.height_m == 0) return false;
    const std::size_t handle = focus();
    hold(handle, {});
    move_to({hold_->begun.from_bridge_m + step.from_bridge_m, hold_->begun.height_m + step.height_m});
    hold_.reset();
    return true;
}

}  // namespace jawari::host::window
