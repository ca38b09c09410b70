#include "scene_run.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "base/cpu_clock.h"
#include "hostile_scene.h"
#include "invariants.h"
#include "jawari/denormals.h"
#include "jawari/scene/compile.h"
#include "jawari/scene/energy.h"
#include "jawari/scene/render.h"
#include "scene_playing.h"
#include "string_watch.h"

namespace jawari::stress {
namespace {

/// Share of the budget for the first pass; the second takes about as long, without the checks.
constexpr double first_share = 0.6;

using Sound = std::vector<std::vector<double>>;  ///< per probe

void render_into(const SceneModel& model, SceneState& state, std::size_t frames, Sound& sound) {
    std::vector<double*> outputs;
    for (std::vector<double>& probe : sound) {
        probe.resize(probe.size() + frames);
        outputs.push_back(probe.data() + probe.size() - frames);
    }
    render(model, state, outputs, frames);
}

/// The last `frames` values of the string's probes.
std::vector<std::span<const double>> tail_of(const Sound& sound, std::size_t first_probe, std::size_t probes,
                                             std::size_t frames) {
    std::vector<std::span<const double>> tail;
    for (std::size_t p = 0; p < probes; ++p)
        tail.push_back(std::span<const double>(sound[first_probe + p]).last(frames));
    return tail;
}

struct Stage {
    const HostileScene& hostile;
    const SceneModel& model;
    const Budget& budget;
    double start_cpu_s = 0;

    [[nodiscard]] bool goes_on(const Report& report) const {
        if (report.exploded) return false;
        if (budget.blocks > 0) return report.blocks < budget.blocks;
        return report.blocks == 0 || host::thread_cpu_s() - start_cpu_s < first_share * budget.cpu_s;
    }
};

void play_checked(const Stage& stage, Report& report, SceneState& state, Sound& sound) {
    std::vector<StringWatch> watches;
    for (std::size_t s = 0; s < stage.model.strings.size(); ++s)
        watches.emplace_back(stage.model.strings[s], state.strings[s], "string " + std::to_string(s));
    ScenePlaying playing(stage.hostile, stage.model, report.seed);
    while (stage.goes_on(report)) {
        const PlayedBlock block = playing.next();
        act(block, stage.model, stage.hostile.height_m, state);
        for (std::size_t s = 0; s < watches.size(); ++s) watches[s].begin_block(state.strings[s]);
        for (std::size_t n = 0; n < block.frames; ++n) {
            render_into(stage.model, state, 1, sound);
            for (std::size_t s = 0; s < watches.size(); ++s) watches[s].note_frame(state.strings[s]);
        }
        std::size_t first_probe = 0;
        for (std::size_t s = 0; s < watches.size(); ++s) {
            const std::size_t probes = stage.model.strings[s].shape->probes.size();
            watches[s].end_block(state.strings[s], tail_of(sound, first_probe, probes, block.frames),
                                 report.judge);
            first_probe += probes;
        }
        report.blocks += 1;
        report.frames += block.frames;
        for (const StringWatch& watch : watches)
            report.exploded |= !(watch.highest_energy() <= largest_energy_J);
    }
}

/// The same playing; what lies between two actions of the player is cut anew.
void play_recut(const Stage& stage, const Report& report, SceneState& state, Sound& sound) {
    ScenePlaying playing(stage.hostile, stage.model, report.seed);
    Dice dice(~report.seed);
    std::size_t waiting = 0;
    const auto render_waiting = [&] {
        while (waiting > 0) {
            const std::size_t frames = dice.chance(0.3) ? 1 : dice.spread_whole(1, waiting);
            render_into(stage.model, state, frames, sound);
            waiting -= frames;
        }
    };
    for (std::uint64_t b = 0; b < report.blocks; ++b) {
        const PlayedBlock block = playing.next();
        if (block.acts()) {
            render_waiting();
            act(block, stage.model, stage.hostile.height_m, state);
        }
        waiting += block.frames;
    }
    render_waiting();
}

void check_repetition(const SceneModel& model, const SceneState& first, const SceneState& second,
                      const Sound& sound, const Sound& recut, Judge& judge) {
    for (std::size_t p = 0; p < sound.size(); ++p)
        check_same(judge, sound[p], recut[p], "probe " + std::to_string(p));
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        const std::string name = "string " + std::to_string(s);
        check_same(judge, first.strings[s].displacement, second.strings[s].displacement, name + " q");
        check_same(judge, first.strings[s].velocity, second.strings[s].velocity, name + " v");
    }
}

void count(const HostileScene& hostile, const SceneModel& model, const SceneState& state, Report& report) {
    report.strings = model.strings.size();
    report.sound_s = static_cast<double>(report.frames) / hostile.description.output_rate_hz;
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        report.contacts += model.strings[s].shape->contact_count;
        report.impulses += state.strings[s].counters.impulses;
        report.truncated += state.strings[s].counters.truncated_solves;
    }
}

/// A strongly damped mode comes from far away: its backward velocity may be e^350 times what it is now, and H
/// the square of that (exact_backward_velocity, step_coefficients.cpp). Nothing can be said of such a string.
bool start_is_finite(const SceneModel& model) {
    return std::all_of(model.strings.begin(), model.strings.end(), [](const StringModel& string) {
        return energy(string, make_string_state(string)) < largest_energy_J;
    });
}

}  // namespace

Report run_scene(std::uint64_t seed, const Budget& budget) {
    const double start_cpu_s = host::thread_cpu_s();
    Report report;
    report.seed = seed;
    const HostileScene hostile = make_hostile_scene(seed);
    report.kind = hostile.kind;
    const auto compiled = compile(hostile.description);
    if (compiled && !start_is_finite(compiled.value())) {
        report.refused = "the energy of the start overflows";
    } else if (compiled) {
        const SceneModel& model = compiled.value();
        const Stage stage{hostile, model, budget, start_cpu_s};
        std::optional<NoDenormals> guard;
        if (!hostile.denormals) guard.emplace();
        SceneState state = make_state(model, hostile.metering, hostile.skipping);
        SceneState again = make_state(model, hostile.metering, hostile.skipping);
        Sound sound(model.probe_count), recut(model.probe_count);
        play_checked(stage, report, state, sound);
        play_recut(stage, report, again, recut);
        check_repetition(model, state, again, sound, recut, report.judge);
        count(hostile, model, state, report);
    } else {
        report.refused = compiled.failure().line();
    }
    report.cpu_s = host::thread_cpu_s() - start_cpu_s;
    return report;
}

}  // namespace jawari::stress
