#include "stepper.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "commands/simulate/overrides.h"
#include "formats/scene_sound/load_sounds.h"
#include "jawari/denormals.h"
#include "jawari/scene/compile.h"
#include "jawari/scene/energy.h"
#include "jawari/scene/render.h"
#include "jawari/scene/snapshot.h"

namespace jawari::python {

host::Outcome<std::unique_ptr<Stepper>> Stepper::create(host::Scene scene, const RecordOptions& options) {
    if (auto error = host::load_sounds(scene)) return *error;
    if (auto error = host::apply_overrides(options.overrides, scene)) return *error;
    auto compiled = compile(scene.description);
    if (!compiled) return host::explain(compiled.failure(), options.overrides, scene);
    auto model = std::make_shared<const SceneModel>(std::move(compiled.value()));
    auto labels = host::probe_labels(scene.description);
    SceneState state =
        make_state(*model, options.meter_steps ? Metering::Step : Metering::Frame, options.skipping);
    return std::unique_ptr<Stepper>(new Stepper(std::make_shared<const host::Scene>(std::move(scene)),
                                                std::move(model), std::move(state), std::move(labels)));
}

Stepper::Stepper(std::shared_ptr<const host::Scene> scene, std::shared_ptr<const SceneModel> model,
                 SceneState state, std::vector<host::ProbeLabel> labels)
    : scene_(std::move(scene)),
      model_(std::move(model)),
      state_(std::move(state)),
      labels_(std::move(labels)) {}

std::unique_ptr<Stepper> Stepper::copy() const {
    return std::unique_ptr<Stepper>(new Stepper(scene_, model_, state_, labels_));
}

std::vector<std::uint8_t> Stepper::save() const {
    return jawari::save(*model_, state_);
}

host::Outcome<bool> Stepper::restore(std::span<const std::uint8_t> bytes) {
    const auto restored = jawari::restore(*model_, bytes, state_);
    if (!restored) return host::invalid_input("state", restored.failure());
    return restored.value() == Restored::Exactly;
}

double Stepper::time_s() const {
    return static_cast<double>(state_.frame) / model_->output_rate_hz;
}

std::vector<double> Stepper::probe_values() const {
    std::vector<double> values;
    for (std::size_t s = 0; s < model_->strings.size(); ++s)
        for (std::size_t p = 0; p < model_->strings[s].shape->probes.size(); ++p)
            values.push_back(
                probe_value(model_->strings[s], state_.strings[s], p, 1 / model_->output_rate_hz));
    return values;
}

std::vector<double> Stepper::gaps(std::size_t string) const {
    const StringShape& shape = *model_->strings[string].shape;
    const StringState& state = state_.strings[string];
    std::vector<double> gaps(shape.contact_count);
    for (std::size_t c = 0; c < gaps.size(); ++c) {
        const double* row = shape.contact_rows.data() + c * shape.stride;
        double u = 0;
        for (std::size_t k = 0; k < shape.mode_count; ++k) u += row[k] * state.displacement[k];
        gaps[c] = u - state.contact.height[c];
    }
    return gaps;
}

std::vector<std::size_t> Stepper::contacts(std::size_t string) const {
    const StringShape& shape = *model_->strings[string].shape;
    std::vector<std::size_t> described(shape.contact_count);
    for (std::size_t c = 0; c < shape.contact_of_description.size(); ++c)
        if (shape.contact_of_description[c] >= 0)
            described[static_cast<std::size_t>(shape.contact_of_description[c])] = c;
    return described;
}

void Stepper::advance(std::size_t frames, std::vector<std::vector<double>>& values) {
    const NoDenormals guard;
    std::vector<double*> outputs(values.size());
    for (std::size_t p = 0; p < values.size(); ++p) {
        values[p].resize(values[p].size() + frames);
        outputs[p] = values[p].data() + values[p].size() - frames;
    }
    render(*model_, state_, outputs, frames);
}

void Stepper::set_modes(std::size_t string, const double* displacement, const double* velocity) {
    StringState& state = state_.strings[string];
    const std::size_t modes = model_->strings[string].shape->mode_count;
    std::copy_n(displacement, modes, state.displacement.begin());
    std::copy_n(velocity, modes, state.velocity.begin());
    notice_change(model_->strings[string], state);
}

void Stepper::move_contact(std::size_t string, std::size_t contact, double height_m, double duration_s) {
    const double steps = std::round(duration_s * model_->contact_rate_hz);
    jawari::move_contact(model_->strings[string], state_.strings[string], contact, height_m,
                         static_cast<std::size_t>(std::max(1.0, steps)));
}

void Stepper::reset() {
    jawari::reset(*model_, state_);
}

}  // namespace jawari::python
