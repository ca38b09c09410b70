#include "instrument_run.h"

#include <algorithm>
#include <vector>

#include "base/cpu_clock.h"
#include "hostile_music.h"
#include "instrument_watch.h"
#include "invariants.h"
#include "jawari/denormals.h"
#include "jawari/instrument/compile.h"
#include "jawari/instrument/qualities.h"
#include "sound.h"

namespace jawari::stress {
namespace {

/// Share of the budget for the first pass; the second is cheaper, as it checks nothing.
constexpr double first_share = 0.7;

/// Those of the events from `begin` to `end`, counted from `begin`.
std::vector<InstrumentEvent> events_between(const std::vector<InstrumentEvent>& events, std::size_t begin,
                                            std::size_t end) {
    std::vector<InstrumentEvent> chosen;
    for (const InstrumentEvent& event : events) {
        if (event.frame < begin || event.frame >= end) continue;
        chosen.push_back(event);
        chosen.back().frame -= begin;
    }
    return chosen;
}

void change_qualities(const MusicBlock& block, const InstrumentModel& model, InstrumentState& state) {
    for (const QualityChange& change : block.quality_changes)
        change_quality(model, state, change.string, change.quality_level);
}

struct Stage {
    const HostileInstrument& hostile;
    const InstrumentModel& model;
    const Budget& budget;
    double start_cpu_s = 0;

    [[nodiscard]] bool goes_on(const Report& report) const {
        if (budget.blocks > 0) return report.blocks < budget.blocks;
        return report.blocks == 0 || host::thread_cpu_s() - start_cpu_s < first_share * budget.cpu_s;
    }
};

void play_checked(const Stage& stage, std::size_t piece_frames, Report& report, InstrumentState& state,
                  Sound& sound) {
    InstrumentWatch watch(stage.model, stage.hostile.description, piece_frames == 1);
    HostileMusic music(stage.model, report.seed);
    while (stage.goes_on(report)) {
        const MusicBlock block = music.next();
        watch.begin_piece(state);
        change_qualities(block, stage.model, state);
        for (std::size_t done = 0; done < block.frames;) {
            const std::size_t frames = std::min(piece_frames, block.frames - done);
            if (done > 0) watch.begin_piece(state);
            render_instrument(stage.model, state, events_between(block.events, done, done + frames),
                              sound.append(frames), frames);
            watch.end_piece(state, sound.tail(frames), report.judge);
            done += frames;
        }
        report.blocks += 1;
        report.frames += block.frames;
    }
}

/// The same music; what lies between two changes of quality is cut anew.
void play_recut(const Stage& stage, const Report& report, InstrumentState& state, Sound& sound) {
    HostileMusic music(stage.model, report.seed);
    Dice dice(~report.seed);
    MusicBlock waiting;
    waiting.frames = 0;
    const auto render_waiting = [&] {
        for (std::size_t done = 0; done < waiting.frames;) {
            const std::size_t frames = dice.spread_whole(1, waiting.frames - done);
            render_instrument(stage.model, state, events_between(waiting.events, done, done + frames),
                              sound.append(frames), frames);
            done += frames;
        }
        waiting.frames = 0;
        waiting.events.clear();
    };
    for (std::uint64_t b = 0; b < report.blocks; ++b) {
        const MusicBlock block = music.next();
        if (!block.quality_changes.empty() || waiting.frames > 4096) {
            render_waiting();
            change_qualities(block, stage.model, state);
        }
        for (InstrumentEvent event : block.events) {
            event.frame += waiting.frames;
            waiting.events.push_back(event);
        }
        waiting.frames += block.frames;
    }
    render_waiting();
}

void count(const Stage& stage, const InstrumentState& state, Report& report) {
    const Counters counters = contact_counters(state);
    report.strings = stage.model.strings.size();
    report.impulses = counters.impulses;
    report.truncated = counters.truncated_solves;
    report.notes = state.counters.notes + state.counters.legato_notes;
    report.sound_s = static_cast<double>(report.frames) / stage.model.output_rate_hz;
    for (const InstrumentStringModel& string : stage.model.strings)
        report.contacts += string.stopped.front().string.shape->contact_count;
}

void play(const Stage& stage, Report& report) {
    const NoDenormals guard;  // as jawari plays and renders
    Dice dice(report.seed + 1);
    const auto piece_frames = static_cast<std::size_t>(dice.pick({1, 1, 7, 64}));
    const PlayMode mode = dice.chance(0.3) ? PlayMode::Guitar : PlayMode::Keyboard;
    InstrumentState state = make_instrument_state(stage.model);
    InstrumentState again = make_instrument_state(stage.model);
    state.play = again.play = mode;
    Sound sound, recut;
    play_checked(stage, piece_frames, report, state, sound);
    play_recut(stage, report, again, recut);
    check_same(report.judge, sound.left, recut.left, "left");
    check_same(report.judge, sound.right, recut.right, "right");
    count(stage, state, report);
}

}  // namespace

Report run_instrument(const PresetShelf& shelf, std::uint64_t seed, const Budget& budget) {
    const double start_cpu_s = host::thread_cpu_s();
    Report report;
    report.seed = seed;
    const HostileInstrument hostile = make_hostile_instrument(shelf, seed);
    report.kind = hostile.kind;
    auto compiled = compile_instrument(hostile.description, hostile.output_rate_hz);
    if (!compiled) {
        report.refused = compiled.failure().line();
    } else if (const auto failure = add_qualities(compiled.value(), hostile.description, hostile.lower)) {
        report.refused = failure->line();
    } else {
        play({hostile, compiled.value(), budget, start_cpu_s}, report);
    }
    report.cpu_s = host::thread_cpu_s() - start_cpu_s;
    return report;
}

}  // namespace jawari::stress
