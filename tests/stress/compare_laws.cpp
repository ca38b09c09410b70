#include "compare_laws.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "hostile_scene.h"
#include "jawari/scene/compile.h"
#include "jawari/scene/energy.h"
#include "jawari/scene/render.h"

namespace jawari::stress {
namespace {

constexpr ImpactLaw laws[] = {ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::Signorini,
                              ImpactLaw::PaoliSchatzman};
/// Multiply-adds that a string is stepped for.
constexpr double work_of_string = 1e7;
constexpr double most_steps = 3000;

bool takes_part(const HostileScene& hostile, bool of_tables) {
    const StringDescription& string = hostile.description.strings.front();
    return hostile.description.scheme == Scheme::Exact && hostile.kind.find("extreme") == std::string::npos &&
           std::holds_alternative<ModeTable>(string.modes) == of_tables && !string.contacts.empty() &&
           string.contacts.size() <= 300 && !std::holds_alternative<AtRest>(string.initial.shape);
}

/// Whether no contact was closed a step before the start. A motion that would have come through an obstacle
/// has no past that the laws' proofs could begin with.
bool has_a_past(const StringModel& model, const StringState& state) {
    for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
        double gap_before = -model.shape->contact_height[c];
        for (std::size_t k = 0; k < model.shape->mode_count; ++k)
            gap_before += model.shape->contact_rows.data()[c * model.shape->stride + k] *
                          (state.displacement[k] - model.shape->step_s * state.velocity[k]);
        if (gap_before < 0) return false;
    }
    return true;
}

void step_under_law(SceneDescription scene, double height_m, LawRecord& record) {
    scene.law = record.law;
    scene.strings.resize(1);
    scene.strings.front().initial.start = Start::Exact;
    const auto compiled = compile(scene);
    if (!compiled) return;
    const StringModel& model = compiled.value().strings.front();
    StringState state = make_string_state(model, Metering::Step);
    const double start_J = energy(model, state);
    if (!(start_J > 0 && start_J < 1e100 && has_a_past(model, state))) return;
    const double work = static_cast<double>((model.shape->mode_count + 8) * (model.shape->contact_count + 6));
    const auto steps = static_cast<std::size_t>(std::min(most_steps, work_of_string / work));
    for (std::size_t n = 0; n < steps && state.energy.highest < 1e120 * start_J; ++n) step(model, state);
    if (state.counters.impulses == 0) return;
    const double gain = state.energy.highest / start_J;
    record.scenes += 1;
    record.impulses += state.counters.impulses;
    record.rose += gain > 1 + 1e-6;
    record.exploded += gain > 1e100;
    record.largest_gain = std::max(record.largest_gain, gain);
    record.deepest = std::max(record.deepest, state.counters.worst_penetration_m / height_m);
}

}  // namespace

std::vector<LawRecord> compare_laws(std::uint64_t seeds, bool of_tables) {
    std::vector<LawRecord> records;
    for (const ImpactLaw law : laws) records.push_back({.law = law});
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const HostileScene hostile = make_hostile_scene(seed);
        if (!takes_part(hostile, of_tables)) continue;
        for (LawRecord& record : records) step_under_law(hostile.description, hostile.height_m, record);
    }
    return records;
}

}  // namespace jawari::stress
