#include "commands/simulate/row_renderer.h"

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <utility>

#include "base/cpu_clock.h"
#include "jawari/denormals.h"
#include "jawari/scene/energy.h"
#include "jawari/scene/render.h"

namespace jawari::host {

namespace {

/// Rows that keep the time between two polls for an interrupt near a tenth of a second, at some 2e9
/// operations per second.
std::size_t rows_between_polls(const SceneModel& model) {
    double per_step = 1;
    for (const StringModel& string : model.strings)
        per_step += static_cast<double>(string.shape->mode_count) *
                    static_cast<double>(10 + string.shape->contact_count);
    const double per_row = per_step * static_cast<double>(model.steps_per_frame);
    return static_cast<std::size_t>(std::clamp(2e8 / per_row, 1.0, 256.0));
}

/// y = S q - b of all contacts: the state's own gaps are those of its last evaluated step.
Eigen::VectorXd gaps_now(const StringModel& model, const StringState& state) {
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto contacts = static_cast<Eigen::Index>(model.shape->contact_count);
    const auto stride = static_cast<Eigen::Index>(model.shape->stride);
    const Eigen::Map<const Matrix> rows(model.shape->contact_rows.data(), contacts, stride);
    const Eigen::Map<const Eigen::VectorXd> q(state.displacement.data(), stride);
    const Eigen::Map<const Eigen::VectorXd> b(state.contact.height.data(), contacts);
    return rows * q - b;
}

void append_contacts(const StringModel& model, const StringState& state, StringRows& rows) {
    const Eigen::VectorXd gaps = gaps_now(model, state);
    for (const std::ptrdiff_t index : model.shape->contact_of_description) {
        const bool kept = index >= 0;
        const auto c = static_cast<std::size_t>(std::max<std::ptrdiff_t>(index, 0));
        rows.gap_m.push_back(kept ? gaps[index] : std::numeric_limits<double>::quiet_NaN());
        rows.impulse_Ns.push_back(kept ? state.contact.frame_impulse[c] : 0.0);
    }
}

void append_energies(const StringModel& model, const StringState& state, Metering metering,
                     StringRows& rows) {
    rows.energy_J.push_back(energy(model, state));
    if (metering != Metering::Step) return;
    rows.dissipated_J.push_back(state.energy.dissipated);
    rows.contact_work_J.push_back(state.energy.contact_work);
    rows.player_work_J.push_back(state.energy.player_work);
}

}  // namespace

RowRenderer::RowRenderer(const SceneModel& model, std::uint64_t last_row, Metering metering,
                         const Skipping& skipping, bool with_contacts, Observer observer)
    : model_(model),
      state_(make_state(model, metering, skipping)),
      observer_(std::move(observer)),
      outputs_(model.probe_count),
      last_row_(last_row),
      rows_per_block_(rows_between_polls(model)),
      metering_(metering),
      with_contacts_(with_contacts) {
    block_.probes.resize(model.probe_count);
}

void RowRenderer::go_on_from(SceneState state) {
    state_ = std::move(state);
    next_row_ = state_.frame;
}

const RowBlock& RowRenderer::next() {
    const NoDenormals guard;
    const std::uint64_t left = last_row_ - next_row_ + 1;
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, rows_per_block_));
    resize_block(count);
    const bool has_last = count == left;
    const std::size_t advancing = has_last ? count - 1 : count;
    if (with_contacts_ || observer_) {
        for (std::size_t i = 0; i < advancing; ++i) {
            observe(i);
            render_rows(i, 1);
        }
        if (has_last) observe(advancing);
    } else {
        render_rows(0, advancing);
    }
    if (has_last) write_last_row(advancing);
    next_row_ += count;
    return block_;
}

void RowRenderer::resize_block(std::size_t count) {
    block_.first = next_row_;
    block_.count = count;
    for (auto& probe : block_.probes) probe.resize(count);
    block_.strings.assign(with_contacts_ ? model_.strings.size() : 0, {});
}

void RowRenderer::observe(std::size_t offset) {
    if (observer_) observer_(next_row_ + offset, state_);
    if (!with_contacts_) return;
    for (std::size_t s = 0; s < model_.strings.size(); ++s) {
        append_contacts(model_.strings[s], state_.strings[s], block_.strings[s]);
        append_energies(model_.strings[s], state_.strings[s], metering_, block_.strings[s]);
    }
}

void RowRenderer::render_rows(std::size_t offset, std::size_t count) {
    for (std::size_t p = 0; p < outputs_.size(); ++p) outputs_[p] = block_.probes[p].data() + offset;
    const double started = thread_cpu_s();
    render(model_, state_, outputs_, count);
    cpu_render_s_ += thread_cpu_s() - started;
}

/// The state stays at the last row, so that final states and energies belong to the last time.
void RowRenderer::write_last_row(std::size_t offset) {
    std::size_t output = 0;
    for (std::size_t s = 0; s < model_.strings.size(); ++s)
        for (std::size_t p = 0; p < model_.strings[s].shape->probes.size(); ++p)
            block_.probes[output++][offset] =
                probe_value(model_.strings[s], state_.strings[s], p, 1 / model_.output_rate_hz);
}

}  // namespace jawari::host
