// Rendering takes no memory and asks nothing of the system: both are trapped, and the traps are shown to
// work.
#include "jawari/realtime.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <vector>

#include "jawari/jawari.h"
#include "string/state/excitation.h"
#include "support/scenes.h"
#include "support/small_instrument.h"

#include "realtime_traps.h"

#ifdef JAWARI_TRAPS

namespace jawari {
namespace {

using test::Trap;
using test::used;

TEST(Realtime, TheAllocationTrapFires) {
    const auto trapped = [](const std::function<void()>& act) {
        const Trap zone;
        act();
        return allocations;
    };
    EXPECT_EQ(trapped([] {}), 0U);
    EXPECT_EQ(trapped([] { std::free(used(std::malloc(10))); }), 2U);
    EXPECT_EQ(trapped([] { std::free(used(std::calloc(10, 3))); }), 2U);
    EXPECT_EQ(trapped([] { std::free(used(std::realloc(used(std::malloc(10)), 100))); }), 3U);
    EXPECT_EQ(trapped([] { std::free(used(std::aligned_alloc(64, 128))); }), 2U);
    EXPECT_EQ(trapped([] { delete used(new int(3)); }), 2U);
    EXPECT_EQ(trapped([] {
                  AlignedVector<double> x(100, 1.0);
                  used(x.data());
              }),
              2U);
    EXPECT_GE(trapped([] {
                  std::vector<int> x;
                  x.push_back(1);
                  used(x.data());
              }),
              2U);
}

/// Everything an audio thread may do with a scene, through every branch that the scene reaches.
struct Performance {
    SceneModel model;
    SceneState state;
    std::vector<double> samples;
    std::vector<double*> outputs;
    AlignedVector<double> force_row;
    static constexpr std::size_t block = 64;

    Performance(ImpactLaw law, Scheme scheme, Metering metering, Skipping skipping) {
        SceneDescription scene;
        scene.contact_rate_hz = 96000;
        scene.law = law;
        scene.scheme = scheme;
        scene.theta = 0.75;
        scene.strings.push_back(test::bass_string(862));
        scene.strings.push_back(test::bass_string(60));
        for (auto& contact : scene.strings[0].contacts) contact.restitution = 0.5;
        scene.strings[0].contacts.push_back({0.4, 0.004, 0, Side::Above});
        scene.strings[0].probes = {{Quantity::Displacement, 0.5, 0},
                                   {Quantity::Velocity, 0.5, 0},
                                   {Quantity::ContactForce, 0, 3},
                                   {Quantity::Energy, 0, 0}};
        model = compile(scene).value();
        state = make_state(model, metering, skipping);
        force_row.assign(model.strings[0].shape->stride, 0.0);
        for (std::size_t k = 0; k < model.strings[0].shape->mode_count; ++k)
            force_row[k] = mode_shape(k + 1, 0.1, model.strings[0].shape->length_m);
        samples.assign(model.probe_count * block, 0.0);
        for (std::size_t p = 0; p < model.probe_count; ++p) outputs.push_back(samples.data() + p * block);
    }

    void play() {
        StringState& string = state.strings[0];
        const StringModel& string_model = model.strings[0];
        for (int n = 0; n < 2; ++n) render(model, state, outputs, block);
        reset(model, state);
        for (int n = 0; n < 6; ++n) render(model, state, outputs, block);
        move_contact(string_model, string, 5, 1e-3, 100);
        clear_excitation(string);
        add_force(string, force_row.data(), string_model.shape->stride, 0.1, 1e-4);
        for (int n = 0; n < 3; ++n) render(model, state, outputs, block);
        // A solve without room is truncated; the workspace only shrinks.
        string.lcp.capacity = 1;
        string.lcp.active_count = 0;
        for (int n = 0; n < 3; ++n) render(model, state, outputs, block);
        string.displacement[3] = std::nan("");
        notice_change(string_model, string);
        render(model, state, outputs, block);
        put_to_rest(model.strings[1], state.strings[1]);
        for (int n = 0; n < 2; ++n) render(model, state, outputs, block);
        reset(string_model, string);
        for (int n = 0; n < 2; ++n) render(model, state, outputs, block);
    }
};

std::vector<std::unique_ptr<Performance>> performances() {
    std::vector<std::unique_ptr<Performance>> all;
    for (const Skipping& skipping : {skip_all, skip_nothing}) {
        for (const ImpactLaw law :
             {ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::Signorini, ImpactLaw::PaoliSchatzman}) {
            all.push_back(std::make_unique<Performance>(law, Scheme::Exact, Metering::Off, skipping));
        }
    }
    all.push_back(
        std::make_unique<Performance>(ImpactLaw::Signorini, Scheme::Exact, Metering::Step, skip_all));
    all.push_back(std::make_unique<Performance>(ImpactLaw::Newton, Scheme::Exact, Metering::Frame, skip_all));
    all.push_back(std::make_unique<Performance>(ImpactLaw::Newton, Scheme::Theta, Metering::Off, skip_all));
    return all;
}

/// A storm of every event that instruments know, in blocks.
struct InstrumentPerformance {
    static constexpr std::size_t block = 64;
    static constexpr std::size_t blocks = 80;
    InstrumentModel model;
    InstrumentState state;
    std::vector<std::vector<InstrumentEvent>> events{blocks};
    std::vector<double> left, right;
    std::uint64_t notes = 0;  ///< before the reset

    explicit InstrumentPerformance(PlayMode mode) {
        model = compile_instrument(test::small_instrument(), 48000).value();
        state = make_instrument_state(model);
        state.play = mode;
        left.assign(block, 0.0);
        right.assign(block, 0.0);
        for (InstrumentEvent event : test::storm(mode == PlayMode::Guitar ? 5 : 6, block * blocks, 400)) {
            std::vector<InstrumentEvent>& here = events[event.frame / block];
            event.frame %= block;
            here.push_back(event);
        }
    }

    void play() {
        const PlayMode mode = state.play;
        for (std::size_t i = 0; i < events.size(); ++i) {
            if (i == events.size() / 2) {
                notes = state.counters.notes;
                reset(model, state);
                state.play = mode;
            }
            render_instrument(model, state, events[i], InstrumentOutput{left.data(), right.data(), {}},
                              block);
        }
    }
};

std::vector<std::unique_ptr<InstrumentPerformance>> instrument_performances() {
    std::vector<std::unique_ptr<InstrumentPerformance>> all;
    for (const PlayMode mode : {PlayMode::Keyboard, PlayMode::Guitar})
        all.push_back(std::make_unique<InstrumentPerformance>(mode));
    return all;
}

TEST(Realtime, PlayingAnInstrumentTakesNoMemory) {
    for (const auto& performance : instrument_performances()) {
        unsigned long hits = 0;
        {
            const Trap zone;
            performance->play();
            hits = allocations;
        }
        EXPECT_EQ(hits, 0U);
        EXPECT_GT(performance->notes + performance->state.counters.notes, 10U);
        EXPECT_NE(performance->state.work.bends_J, 0);
    }
}

TEST(Realtime, RenderingTakesNoMemory) {
    for (const auto& performance : performances()) {
        unsigned long hits = 0;
        {
            const Trap zone;
            performance->play();
            hits = allocations;
        }
        EXPECT_EQ(hits, 0U);
        EXPECT_GT(
            performance->state.strings[1].counters.impulses + performance->state.strings[0].counters.impulses,
            0U);
    }
}

#ifdef JAWARI_TRAPS_SYSTEM_CALLS

constexpr int no_filter = 99;
constexpr int trap_is_dead = 98;

/// Exit code: system calls made by the performances, or one of the codes above.
[[noreturn]] void play_without_system_calls(
    const std::vector<std::unique_ptr<Performance>>& all,
    const std::vector<std::unique_ptr<InstrumentPerformance>>& instruments) {
    if (!test::trap_system_calls()) _exit(no_filter);
    syscall(SYS_getppid);
    if (test::system_calls != 1) _exit(trap_is_dead);
    for (const auto& performance : all) performance->play();
    for (const auto& performance : instruments) performance->play();
    _exit(std::min(static_cast<int>(test::system_calls) - 1, 90));
}

TEST(Realtime, RenderingMakesNoSystemCalls) {
    const auto all = performances();
    const auto instruments = instrument_performances();
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) play_without_system_calls(all, instruments);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    if (WEXITSTATUS(status) == no_filter)
        GTEST_SKIP() << "this system does not let a process filter its calls";
    EXPECT_NE(WEXITSTATUS(status), trap_is_dead);
    EXPECT_EQ(WEXITSTATUS(status), 0) << "system calls while rendering";
}

#endif

}  // namespace
}  // namespace jawari

#else

namespace jawari {
namespace {

TEST(Realtime, IsTestedWithoutSanitizers) {
    GTEST_SKIP() << "sanitizers own the allocator";
}

}  // namespace
}  // namespace jawari

#endif
