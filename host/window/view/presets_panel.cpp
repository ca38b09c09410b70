#include "window/view/presets_panel.h"

#include <algorithm>

namespace jawari::host::window {

using theme::grid;

PresetsPanel::PresetsPanel(Shared& shared)
    : Panel(shared), presets_(list_presets()), version_(shared.performance.preset().version) {
    find();
    const std::string& name = shared_.performance.preset().name;
    for (std::size_t row = 0; row < found_.size(); ++row)
        if (presets_[found_[row]].name == name) marked_ = row;
}

void PresetsPanel::find() {
    found_ = search_presets(presets_, query_);
    first_ = 0;
    marked_ = 0;
    shared_.still_changed = true;
}

void PresetsPanel::follow(double /*passed_s*/) {
    const bool compiling = shared_.performance.facts().compiling;
    const unsigned version = shared_.performance.preset().version;
    if (version == version_ && compiling == compiling_) return;
    version_ = version;
    compiling_ = compiling;
    shared_.still_changed = true;
}

std::size_t PresetsPanel::visible_rows() const {
    return static_cast<std::size_t>(std::max(1.0F, shared_.layout.list.height / preset_row_height));
}

void PresetsPanel::show_row(std::size_t row) {
    if (row < first_) first_ = row;
    if (row >= first_ + visible_rows()) first_ = row - visible_rows() + 1;
    shared_.still_changed = true;
}

void PresetsPanel::choose(std::size_t row) {
    if (row >= found_.size()) return;
    marked_ = row;
    show_row(row);
    shared_.performance.load_preset(presets_[found_[row]].name);
    shared_.presets_open = false;
}

// ---------------------------------------------------------------------------------------------- drawing

void PresetsPanel::draw_still(Canvas& canvas) {
    canvas.box(shared_.layout.head, theme::surface);
    draw_head(canvas);
    if (shared_.layout.wide) draw_list(canvas);
}

void PresetsPanel::draw_over(Canvas& canvas) {
    if (!shared_.layout.wide && shared_.presets_open) draw_list(canvas);
}

void PresetsPanel::draw_head(Canvas& canvas) {
    const Layout& layout = shared_.layout;
    const PresetInForce& preset = shared_.performance.preset();
    const auto listed = std::find_if(presets_.begin(), presets_.end(),
                                     [&](const ListedPreset& one) { return one.name == preset.name; });
    if (layout.wide)
        canvas.text({2 * grid, 0, layout.description.x - 4 * grid, layout.head.height}, "Jawari",
                    theme::large_type, theme::string);
    else {
        canvas.box(layout.presets_button, theme::raised, 4);
        canvas.text(layout.presets_button, "Presets", theme::type, theme::text, TextPlace::Middle);
    }
    const Box& box = layout.description;
    std::string title = listed == presets_.end() ? preset.name : listed->title;
    if (preset.edited) title += " (changed)";
    if (compiling_) title += " …";
    canvas.text({box.x, box.y - 2, box.width, 24}, title, theme::large_type, theme::text);
    if (listed != presets_.end())
        canvas.text({box.x, box.y + 23, box.width, 18}, listed->description, theme::small_type, theme::quiet);
}

void PresetsPanel::draw_list(Canvas& canvas) {
    const Layout& layout = shared_.layout;
    canvas.box(layout.presets, theme::surface, 6);
    if (!layout.wide) canvas.frame(layout.presets, theme::line, 1, 6);
    canvas.box(layout.search, theme::raised, 4);
    const bool typing = focus() == search_stop;
    const Box text{layout.search.x + grid, layout.search.y, layout.search.width - 2 * grid,
                   layout.search.height};
    if (query_.empty() && !typing)
        canvas.text(text, "Search presets", theme::type, theme::quiet);
    else
        canvas.text(text, query_ + (typing ? "|" : ""), theme::type, theme::text);
    if (shows_focus(search_stop)) draw_focus(canvas, layout.search);
    for (std::size_t n = 0; n < visible_rows() && first_ + n < found_.size(); ++n)
        draw_row(canvas,
                 {layout.list.x, layout.list.y + static_cast<float>(n) * preset_row_height, layout.list.width,
                  preset_row_height},
                 first_ + n);
    if (found_.empty())
        canvas.text({layout.list.x + grid, layout.list.y, layout.list.width - grid, preset_row_height},
                    "No preset has these words", theme::type, theme::quiet);
}

void PresetsPanel::draw_row(Canvas& canvas, const Box& box, std::size_t row) {
    const ListedPreset& preset = presets_[found_[row]];
    const bool plays = preset.name == shared_.performance.preset().name;
    if (row == under_ || plays) canvas.box(box, theme::raised, 4);
    if (plays) canvas.box({box.x, box.y + 5, 3, box.height - 10}, theme::string, 1.5F);
    canvas.text({box.x + 1.5F * grid, box.y, box.width - 2 * grid, box.height}, preset.title, theme::type,
                plays ? theme::string : theme::text);
    if (shows_focus(list_stop) && row == marked_)
        draw_focus(canvas, {box.x + 3, box.y + 3, box.width - 6, box.height - 6});
}

// ---------------------------------------------------------------------------------------------- mouse, keys

bool PresetsPanel::covers(const Pointer& pointer) const {
    if (shared_.layout.presets_button.has(pointer.x, pointer.y)) return true;
    return is_shown() && shared_.layout.presets.has(pointer.x, pointer.y);
}

bool PresetsPanel::press(const Pointer& pointer) {
    if (shared_.layout.presets_button.has(pointer.x, pointer.y)) {
        shared_.presets_open = !shared_.presets_open;
        shared_.still_changed = true;
        return true;
    }
    if (!covers(pointer)) {
        if (shared_.presets_open) shared_.still_changed = true;
        shared_.presets_open = false;
        return false;
    }
    shared_.still_changed = true;
    if (shared_.layout.search.has(pointer.x, pointer.y)) {
        set_focus(search_stop);
        return true;
    }
    set_focus(no_stop);
    if (shared_.layout.list.has(pointer.x, pointer.y))
        choose(first_ + static_cast<std::size_t>((pointer.y - shared_.layout.list.y) / preset_row_height));
    return true;
}

bool PresetsPanel::hover(const Pointer& pointer) {
    const std::size_t before = under_;
    under_ = no_stop;
    if (!covers(pointer)) {
        if (before != no_stop) shared_.still_changed = true;
        return false;
    }
    if (shared_.layout.list.has(pointer.x, pointer.y))
        under_ = first_ + static_cast<std::size_t>((pointer.y - shared_.layout.list.y) / preset_row_height);
    if (under_ != before) {
        shared_.still_changed = true;
        if (under_ < found_.size()) shared_.say(presets_[found_[under_]].description);
    }
    return true;
}

void PresetsPanel::leave() {
    if (under_ != no_stop) shared_.still_changed = true;
    under_ = no_stop;
}

bool PresetsPanel::scroll(const Pointer& pointer, float lines) {
    if (!covers(pointer)) return false;
    const std::size_t last = found_.size() > visible_rows() ? found_.size() - visible_rows() : 0;
    if (lines > 0)
        first_ -= std::min<std::size_t>(first_, 2);
    else
        first_ = std::min(first_ + 2, last);
    shared_.still_changed = true;
    return true;
}

bool PresetsPanel::type_key(const KeyPress& press) {
    if (press.key == KeyName::Delete && !query_.empty()) {
        do query_.pop_back();
        while (!query_.empty() && (static_cast<unsigned char>(query_.back()) & 0xC0U) == 0x80U);
        find();
        return true;
    }
    if (press.key == KeyName::Escape) {
        query_.clear();
        set_focus(no_stop);
        find();
        return true;
    }
    if (press.key == KeyName::Enter && !found_.empty()) {
        choose(0);
        return true;
    }
    return press.key == KeyName::Delete;
}

bool PresetsPanel::key(const KeyPress& press) {
    if (focus() == search_stop) return type_key(press);
    if (found_.empty()) return false;
    switch (press.key) {
        case KeyName::Up:
            marked_ -= std::min<std::size_t>(marked_, 1);
            break;
        case KeyName::Down:
            marked_ = std::min(marked_ + 1, found_.size() - 1);
            break;
        case KeyName::Home:
            marked_ = 0;
            break;
        case KeyName::End:
            marked_ = found_.size() - 1;
            break;
        case KeyName::Enter:
            choose(marked_);
            return true;
        default:
            return false;
    }
    show_row(marked_);
    shared_.say(presets_[found_[marked_]].description);
    return true;
}

bool PresetsPanel::character(std::uint32_t character, const char* text) {
    constexpr std::size_t longest_query = 64;
    if (focus() != search_stop || character < ' ' || character == 0x7F) return false;
    if (query_.size() < longest_query) query_ += text;
    find();
    return true;
}

}  // namespace jawari::host::window
