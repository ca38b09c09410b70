#include "plugin/editor/plugin_performance.h"

#include <chrono>
#include <utility>

#include "instrument/preset_library.h"

namespace jawari::host {

PluginPerformance::PluginPerformance(PluginCore& core, EditorHost host)
    : core_(core), host_(std::move(host)) {
    follow_preset();
}

PluginPerformance::~PluginPerformance() {
    if (compiling_.valid()) compiling_.wait();
}

void PluginPerformance::wake() {
    if (host_.wake) host_.wake();
}

void PluginPerformance::begin_edit(ParameterId parameter) {
    if (host_.begin_edit) host_.begin_edit(parameter);
}

void PluginPerformance::edit(ParameterId parameter, double value) {
    if (!host_.value) core_.set_value(parameter, value);
    if (host_.edit) host_.edit(parameter, host_.value ? value : core_.value(parameter));
}

void PluginPerformance::end_edit(ParameterId parameter) {
    if (host_.end_edit) host_.end_edit(parameter);
}

/// The host loads states and presets too.
void PluginPerformance::follow_preset() {
    const PluginState& state = core_.state();
    if (core_.instrument() == preset_.instrument && state.preset_text == preset_.text) return;
    preset_.instrument = core_.instrument();
    preset_.name = state.preset_name;
    preset_.text = state.preset_text;
    const auto library = preset_text(preset_.name);
    preset_.edited = !library || library.value() != preset_.text;
    preset_.version += 1;
}

void PluginPerformance::begin(Wish wish) {
    if (compiling_.valid()) {
        next_ = std::move(wish);
        return;
    }
    CompileOrder order = core_.compile_order();
    order.state.preset_name = wish.name;
    order.state.preset_text = wish.text;
    compiling_ = std::async(std::launch::async, [order, wish] {
        return Compiled{order, wish, compile_state(order.state, order.quality, order.rate_hz)};
    });
}

void PluginPerformance::load_preset(const std::string& name) {
    const auto text = preset_text(name);
    if (!text) {
        lines_.push_back(text.error().message);
        return;
    }
    begin({name, text.value(), true});
}

void PluginPerformance::edit_preset(const std::string& text) {
    begin({core_.state().preset_name, text, false});
}

/// A host that keeps the values would otherwise put back the old ones.
void PluginPerformance::tell_neutral_values() {
    for (const ParameterDeclaration& parameter : parameter_table()) {
        begin_edit(parameter.id);
        edit(parameter.id, parameter.neutral);
        end_edit(parameter.id);
    }
}

void PluginPerformance::take_compiled() {
    Compiled compiled = compiling_.get();
    MaybeError failure;
    if (!compiled.state) {
        failure = compiled.state.error();
    } else if (core_.fits(compiled.order)) {
        if (compiled.wish.neutral) compiled.order.state.parameters = neutral_parameters();
        failure = core_.load_compiled(compiled.order, std::move(compiled.state.value()));
        if (!failure && compiled.wish.neutral && host_.value) tell_neutral_values();
        if (!failure && host_.state_changed) host_.state_changed();
    } else if (!next_) {
        next_ = compiled.wish;  // the host has changed rate, quality or state meanwhile
    }
    if (failure) lines_.push_back(failure->message);
    if (next_) begin(*std::exchange(next_, std::nullopt));
}

void PluginPerformance::tick() {
    core_.collect();
    if (compiling_.valid() && compiling_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        take_compiled();
    follow_preset();
}

window::PerformanceFacts PluginPerformance::facts() {
    window::PerformanceFacts facts;
    facts.compiling = compiling_.valid();
    return facts;
}

std::optional<std::string> PluginPerformance::notice() {
    if (lines_.empty()) return std::nullopt;
    std::string line = std::move(lines_.front());
    lines_.pop_front();
    return line;
}

}  // namespace jawari::host
