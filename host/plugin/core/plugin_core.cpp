// The control thread's side.
#include "plugin/core/plugin_core.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/input_file.h"
#include "base/text.h"
#include "plugin/core/utf8.h"

namespace jawari::host {

namespace {

constexpr double lowest_rate_hz = 8000;
constexpr double highest_rate_hz = 384000;
constexpr std::size_t longest_file_bytes = std::size_t{4} << 20U;

bool is_rate(double rate_hz) {
    return rate_hz >= lowest_rate_hz && rate_hz <= highest_rate_hz;
}

bool ends_in(const std::string& path, std::string_view extension) {
    return lower_case(path).ends_with(extension);
}

std::string stem_of(const std::string& path) {
    const auto slash = path.find_last_of('/');
    const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
    return name.substr(0, name.find_last_of('.'));
}

}  // namespace

PluginCore::PluginCore() : link_(std::make_unique<StageLink>()) {
    for (const ParameterDeclaration& parameter : parameter_table())
        values_[static_cast<std::size_t>(parameter.id)].store(parameter.neutral);
}

PluginCore::~PluginCore() {
    deactivate();
}

StageSettings PluginCore::stage_settings(double rate_hz) const {
    StageSettings settings;
    settings.rate_hz = rate_hz;
    settings.most_frames = chunk_frames;
    settings.interpreter = compiled_.interpreter;
    settings.string_outputs = true;
    settings.link = link_.get();
    return settings;
}

std::unique_ptr<StagedInstrument> PluginCore::staged() const {
    auto made = make_staged(compiled_.instrument, stage_settings(compiled_rate_hz_));
    made->interpreter = std::make_unique<MidiInterpreter>(make_interpreter(compiled_.interpreter));
    return made;
}

/// Compiles unless nothing would change, and sends the new instrument to the stage.
MaybeError PluginCore::put(const PluginState& state, bool offline, double rate_hz) {
    const Quality quality = offline ? state.offline_quality : state.quality;
    const bool known = compiled() && compiled_rate_hz_ == rate_hz && compiled_quality_ == quality &&
                       compile_alike(state_, state);
    if (!known) {
        collect();
        if (active_ && published_ == most_staged_instruments)
            return Error{ErrorKind::Usage, "too many changes wait for the host's next block"};
        auto compiled = compile_state(state, quality, rate_hz);
        if (!compiled) return compiled.error();
        compiled_ = std::move(compiled.value());
        compiled_rate_hz_ = rate_hz;
        compiled_quality_ = quality;
    }
    state_ = state;
    offline_ = offline;
    if (!known && active_) publish();
    return std::nullopt;
}

void PluginCore::publish() {
    std::unique_ptr<StagedInstrument> unheard(next_.exchange(staged().release(), std::memory_order_acq_rel));
    if (unheard == nullptr) published_ += 1;
}

void PluginCore::expect_rate(double rate_hz) {
    if (is_rate(rate_hz)) rate_hz_ = rate_hz;
}

MaybeError PluginCore::activate(double rate_hz) {
    if (!is_rate(rate_hz)) return usage_error("sample rate", shortest(rate_hz), "8000 to 384000 Hz");
    deactivate();
    if (auto error = put(state_, offline_, rate_hz)) return error;
    rate_hz_ = rate_hz;
    stage_ = std::make_unique<Stage>(stage_settings(rate_hz));
    stage_->call(staged().release());
    stage_->take_stage();
    published_ = 1;
    applied_ = neutral_parameters();
    notes_.clear();
    active_ = true;
    return std::nullopt;
}

void PluginCore::deactivate() {
    if (!active_) return;
    active_ = false;
    delete next_.exchange(nullptr);  // NOLINT(cppcoreguidelines-owning-memory): never reached the stage
    stage_->clear();
    give_back();
    collect();
    published_ = 0;
    stage_.reset();
}

void PluginCore::collect() {
    retired_.consume_all([this](StagedInstrument* retired) {
        delete retired;  // NOLINT(cppcoreguidelines-owning-memory): made by staged()
        published_ -= 1;
    });
}

std::string PluginCore::save() const {
    PluginState state = state_;
    for (const ParameterDeclaration& parameter : parameter_table())
        state.parameters[static_cast<std::size_t>(parameter.id)] = value(parameter.id);
    return write_plugin_state(state);
}

MaybeError PluginCore::load(std::string_view text) {
    const auto state = read_plugin_state(text);
    if (!state) return state.error();
    return load(state.value());
}

CompileOrder PluginCore::compile_order() const {
    CompileOrder order{state_, offline_ ? state_.offline_quality : state_.quality, rate_hz_, loads_};
    for (const ParameterDeclaration& parameter : parameter_table())
        order.state.parameters[static_cast<std::size_t>(parameter.id)] = value(parameter.id);
    return order;
}

bool PluginCore::fits(const CompileOrder& order) const {
    const Quality quality = offline_ ? state_.offline_quality : state_.quality;
    return order.rate_hz == rate_hz_ && order.quality == quality && order.loads == loads_;
}

MaybeError PluginCore::load_compiled(const CompileOrder& order, CompiledState compiled) {
    collect();
    if (active_ && published_ == most_staged_instruments)
        return Error{ErrorKind::Usage, "too many changes wait for the host's next block"};
    compiled_ = std::move(compiled);
    compiled_rate_hz_ = order.rate_hz;
    compiled_quality_ = order.quality;
    state_ = order.state;
    const bool neutral = order.state.parameters == neutral_parameters();
    for (const ParameterDeclaration& parameter : parameter_table())
        if (neutral) set_value(parameter.id, parameter.neutral);
    if (active_) publish();
    return std::nullopt;
}

MaybeError PluginCore::load(const PluginState& state) {
    if (auto error = put(state, offline_, rate_hz_)) return error;
    loads_ += 1;
    for (const ParameterDeclaration& parameter : parameter_table())
        set_value(parameter.id, state.parameters[static_cast<std::size_t>(parameter.id)]);
    return std::nullopt;
}

MaybeError PluginCore::load_preset(const std::string& name, const std::string& text) {
    PluginState state = state_;
    state.preset_name = name;
    state.preset_text = text;
    state.parameters = neutral_parameters();
    return load(state);
}

MaybeError PluginCore::load_file(const std::string& path) {
    auto read = read_file(path, longest_file_bytes);
    if (!read) return read.error();
    const std::string text = as_utf8(read.value());
    PluginState state = state_;
    for (const ParameterDeclaration& parameter : parameter_table())
        state.parameters[static_cast<std::size_t>(parameter.id)] = value(parameter.id);
    if (ends_in(path, ".scl") || ends_in(path, ".ascl")) {
        state.scale_text = text;
        state.tun_text.clear();
    } else if (ends_in(path, ".tun")) {
        state.tun_text = text;
        state.scale_text.clear();
        state.keyboard_text.clear();
    } else if (ends_in(path, ".kbm")) {
        state.keyboard_text = text;
    } else if (text.find("\"jawari.midi-map/") != std::string::npos) {
        state.midi_map_text = text;
    } else {
        return load_preset(stem_of(path), text);
    }
    return load(state);
}

MaybeError PluginCore::set_offline(bool offline) {
    if (offline == offline_) return std::nullopt;
    if (active_) return put(state_, offline, rate_hz_);
    offline_ = offline;
    return std::nullopt;
}

double PluginCore::value(ParameterId parameter) const noexcept {
    return values_[static_cast<std::size_t>(parameter)].load(std::memory_order_relaxed);
}

void PluginCore::set_value(ParameterId parameter, double value) noexcept {
    const ParameterDeclaration& declared = declaration_of(parameter);
    if (!std::isfinite(value)) return;
    values_[static_cast<std::size_t>(parameter)].store(std::clamp(value, declared.low, declared.high),
                                                       std::memory_order_relaxed);
}

}  // namespace jawari::host
