#include "recording.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "base/cpu_clock.h"
#include "base/text.h"
#include "commands/simulate/overrides.h"
#include "commands/simulate/simulation_warnings.h"
#include "formats/scene/words.h"
#include "formats/scene_sound/load_sounds.h"
#include "jawari/scene/compile.h"

namespace jawari::python {

namespace {

using host::RowBlock;
using host::StringRows;

std::vector<double> first(const AlignedVector<double>& values, std::size_t count, double factor = 1) {
    std::vector<double> result(count);
    for (std::size_t k = 0; k < count; ++k) result[k] = factor * values[k];
    return result;
}

StringFacts facts_of(const StringDescription& string, const StringModel& model, const StringState& last) {
    StringFacts facts;
    facts.name = string.name;
    facts.length_m = string.length_m;
    facts.linear_density_kg_per_m = string.linear_density_kg_per_m;
    for (std::size_t c = 0; c < string.contacts.size(); ++c) {
        facts.contact_position_m.push_back(string.contacts[c].position_m);
        facts.contact_height_m.push_back(string.contacts[c].height_m);
        facts.contact_restitution.push_back(string.contacts[c].restitution);
        facts.contact_side.push_back(host::word(string.contacts[c].side));
        facts.contact_takes_part.push_back(model.shape->contact_of_description[c] >= 0 ? 1 : 0);
    }
    const std::size_t modes = model.shape->mode_count;
    facts.frequency_hz = first(model.tuning.omega, modes, 1 / (2 * std::numbers::pi));
    facts.decay_per_s = first(model.shape->sigma, modes);
    facts.final_displacement = first(last.displacement, modes);
    facts.final_velocity = first(last.velocity, modes);
    return facts;
}

void append(std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

void reserve(const host::Scene& scene, std::uint64_t rows, const RecordOptions& options,
             Recording& recording) {
    recording.probes.resize(recording.labels.size());
    for (auto& probe : recording.probes) probe.reserve(rows);
    if (!options.with_contacts) return;
    recording.rows.resize(scene.description.strings.size());
    for (std::size_t s = 0; s < recording.rows.size(); ++s) {
        const std::size_t contacts = scene.description.strings[s].contacts.size();
        recording.rows[s].gap_m.reserve(rows * contacts);
        recording.rows[s].impulse_Ns.reserve(rows * contacts);
        recording.rows[s].energy_J.reserve(rows);
    }
}

void store(const RowBlock& block, Recording& recording) {
    for (std::size_t p = 0; p < block.probes.size(); ++p) append(recording.probes[p], block.probes[p]);
    for (std::size_t s = 0; s < block.strings.size(); ++s) {
        const StringRows& rows = block.strings[s];
        append(recording.rows[s].gap_m, rows.gap_m);
        append(recording.rows[s].impulse_Ns, rows.impulse_Ns);
        append(recording.rows[s].energy_J, rows.energy_J);
        append(recording.rows[s].dissipated_J, rows.dissipated_J);
        append(recording.rows[s].contact_work_J, rows.contact_work_J);
        append(recording.rows[s].player_work_J, rows.player_work_J);
    }
}

}  // namespace

host::MaybeError check_duration(double duration_s) {
    if (duration_s >= 0 && duration_s <= host::longest_duration_s) return std::nullopt;
    return host::usage_error("duration_s", host::shortest(duration_s),
                             "0 to " + host::shortest(host::longest_duration_s));
}

host::Outcome<Recording> record(host::Scene scene, const RecordOptions& options, const Poll& poll) {
    if (options.overrides.duration_s)
        if (auto error = check_duration(*options.overrides.duration_s)) return *error;
    if (auto error = host::load_sounds(scene)) return *error;
    if (auto error = host::apply_overrides(options.overrides, scene)) return *error;
    const double started = host::thread_cpu_s();
    const auto compiled = compile(scene.description);
    const double cpu_compile_s = host::thread_cpu_s() - started;
    if (!compiled) return host::explain(compiled.failure(), options.overrides, scene);
    const SceneModel& model = compiled.value();

    const auto last_row =
        static_cast<std::uint64_t>(std::llround(scene.duration_s * scene.description.output_rate_hz));
    const Metering metering = options.meter_steps ? Metering::Step : Metering::Frame;
    Recording recording;
    recording.labels = host::probe_labels(scene.description);
    reserve(scene, last_row + 1, options, recording);
    host::RowRenderer renderer(model, last_row, metering, options.skipping, options.with_contacts);
    const auto resolutions = host::resolutions_at_start(scene.description, model, renderer.state());
    while (!renderer.finished()) {
        if (auto error = poll()) return *error;
        store(renderer.next(), recording);
    }
    recording.stats = host::collect_stats(scene, model, renderer.state(), metering, last_row + 1);
    recording.stats.cpu_compile_s = cpu_compile_s;
    recording.stats.cpu_render_s = renderer.cpu_render_s();
    recording.warnings = host::simulation_warnings(recording.stats, resolutions);
    for (std::size_t s = 0; s < model.strings.size(); ++s)
        recording.strings.push_back(
            facts_of(scene.description.strings[s], model.strings[s], renderer.state().strings[s]));
    return recording;
}

}  // namespace jawari::python
