#include "window/view/parameters_panel.h"

#include <cmath>

#include "plugin/core/parameter_text.h"

namespace jawari::host::window {

namespace {

constexpr std::array<double, parameter_count> no_values() {
    return {};
}

std::size_t index_of(ParameterId parameter) {
    return static_cast<std::size_t>(parameter);
}

}  // namespace

ParametersPanel::ParametersPanel(Shared& shared) : Panel(shared), shown_(no_values()) {
    for (const ParameterDeclaration& parameter : parameter_table())
        shown_[index_of(parameter.id)] = shared_.performance.value(parameter.id);
}

void ParametersPanel::follow(double /*passed_s*/) {
    for (const ParameterDeclaration& parameter : parameter_table()) {
        const double value = shared_.performance.value(parameter.id);
        double& shown = shown_[index_of(parameter.id)];
        if (value == shown) continue;
        shown = value;
        shared_.still_changed = true;
    }
}

void ParametersPanel::draw_still(Canvas& canvas) {
    const Layout& layout = shared_.layout;
    canvas.box(layout.parameters, theme::surface);
    for (const GroupPlace& group : layout.groups)
        canvas.text(group.box, group.name, theme::small_type, theme::quiet);
    for (const ParameterDeclaration& parameter : parameter_table()) draw(canvas, parameter);
}

/// Name and value on one line, below them how far the control is from its neutral value.
void ParametersPanel::draw(Canvas& canvas, const ParameterDeclaration& parameter) {
    const Box& box = shared_.layout.controls[index_of(parameter.id)];
    const double value = shown_[index_of(parameter.id)];
    const bool lit = under_ == parameter.id || (hold_ && hold_->parameter == parameter.id);
    const bool usable = shared_.performance.can_edit(parameter.id);
    const std::string text = parameter_text(parameter.id, value);
    const Box line{box.x, box.y, box.width, 18};
    const float width = canvas.text(
        line, text, theme::type, value == parameter.neutral ? theme::quiet : theme::string, TextPlace::Right);
    const Box label{line.x, line.y, line.width - width - theme::grid, line.height};
    const bool fits = canvas.text_width(parameter.name, theme::type) <= label.width;
    canvas.text(label, fits ? parameter.name : parameter.short_name, theme::type,
                usable ? theme::text : theme::quiet);
    const Box track{box.x, box.y + 20, box.width, 4};
    canvas.box(track, theme::raised, 2);
    const auto x_of = [&](double of) {
        return track.x + track.width * static_cast<float>(parameter_travel(parameter, of));
    };
    const float from = x_of(parameter.neutral);
    const float to = x_of(value);
    if (from != to)
        canvas.box({std::min(from, to), track.y, std::abs(to - from), track.height}, theme::string, 2);
    canvas.segment(from, track.y - 1, from, track.bottom() + 1, theme::quiet, 1, 0.6F);
    canvas.dot(to, track.middle_y(), lit ? 5.5F : 4, lit ? theme::text : theme::string);
    if (shows_focus(index_of(parameter.id))) draw_focus(canvas, {box.x, box.y, box.width, 27});
}

std::optional<ParameterId> ParametersPanel::at(const Pointer& pointer) const {
    for (const ParameterDeclaration& parameter : parameter_table())
        if (shared_.layout.controls[index_of(parameter.id)].has(pointer.x, pointer.y)) return parameter.id;
    return std::nullopt;
}

void ParametersPanel::set_once(ParameterId parameter, double value) {
    if (!shared_.performance.can_edit(parameter)) return;
    shared_.performance.begin_edit(parameter);
    shared_.performance.edit(parameter, value);
    shared_.performance.end_edit(parameter);
}

bool ParametersPanel::press(const Pointer& pointer) {
    if (!shared_.layout.parameters.has(pointer.x, pointer.y)) return false;
    const auto parameter = at(pointer);
    if (!parameter || pointer.button != 1 || !shared_.performance.can_edit(*parameter)) return true;
    set_focus(index_of(*parameter));
    shared_.still_changed = true;
    if (pointer.twice) {
        set_once(*parameter, declaration_of(*parameter).neutral);
        return true;
    }
    hold_.emplace(Hold{*parameter,
                       ControlDrag(declaration_of(*parameter), shared_.performance.value(*parameter)),
                       pointer.x});
    shared_.performance.begin_edit(*parameter);
    return true;
}

void ParametersPanel::drag(const Pointer& pointer) {
    if (!hold_) return;
    const Box& box = shared_.layout.controls[index_of(hold_->parameter)];
    const double value = hold_->drag.move(static_cast<double>(pointer.x - hold_->x),
                                          static_cast<double>(box.width), pointer.shift);
    hold_->x = pointer.x;
    shared_.performance.edit(hold_->parameter, value);
}

void ParametersPanel::release(const Pointer& /*pointer*/) {
    if (!hold_) return;
    shared_.performance.end_edit(hold_->parameter);
    hold_.reset();
    shared_.still_changed = true;
}

bool ParametersPanel::hover(const Pointer& pointer) {
    const auto before = under_;
    under_ = at(pointer);
    if (under_ != before) {
        shared_.still_changed = true;
        if (under_) shared_.say(std::string(declaration_of(*under_).text));
    }
    return shared_.layout.parameters.has(pointer.x, pointer.y);
}

void ParametersPanel::leave() {
    if (under_) shared_.still_changed = true;
    under_.reset();
}

bool ParametersPanel::scroll(const Pointer& pointer, float lines) {
    const auto parameter = at(pointer);
    if (!parameter) return shared_.layout.parameters.has(pointer.x, pointer.y);
    const int steps = lines > 0 ? 1 : -1;
    set_once(*parameter, stepped_value(declaration_of(*parameter), shared_.performance.value(*parameter),
                                       steps, pointer.shift));
    return true;
}

bool ParametersPanel::key(const KeyPress& press) {
    if (focus() >= parameter_count) return false;
    const ParameterDeclaration& parameter = parameter_table()[focus()];
    const double value = shared_.performance.value(parameter.id);
    constexpr int large_step = 10;
    switch (press.key) {
        case KeyName::Left:
        case KeyName::Down:
            set_once(parameter.id, stepped_value(parameter, value, -1, press.shift));
            return true;
        case KeyName::Right:
        case KeyName::Up:
            set_once(parameter.id, stepped_value(parameter, value, 1, press.shift));
            return true;
        case KeyName::PageDown:
            set_once(parameter.id, stepped_value(parameter, value, -large_step, press.shift));
            return true;
        case KeyName::PageUp:
            set_once(parameter.id, stepped_value(parameter, value, large_step, press.shift));
            return true;
        case KeyName::Home:
            set_once(parameter.id, parameter.low);
            return true;
        case KeyName::End:
            set_once(parameter.id, parameter.high);
            return true;
        case KeyName::Delete:
            set_once(parameter.id, parameter.neutral);
            return true;
        default:
            return false;
    }
}

}  // namespace jawari::host::window
