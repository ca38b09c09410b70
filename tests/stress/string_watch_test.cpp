// A watch over a string sees a state that has been tampered with; left alone, the same string passes.
#include "string_watch.h"

#include <gtest/gtest.h>

#include <functional>
#include <initializer_list>
#include <limits>

#include "jawari/scene/compile.h"
#include "jawari/scene/render.h"

namespace jawari::stress {
namespace {

constexpr std::size_t frames = 40;

SceneModel plucked_over_frets() {
    SceneDescription scene;
    scene.output_rate_hz = 48000;
    scene.contact_rate_hz = 480000;
    StringDescription string;
    string.length_m = 0.65;
    string.linear_density_kg_per_m = 0.005;
    PhysicalModes modes;
    modes.count = 40;
    modes.tension_N = 80;
    modes.inharmonicity = 1e-5;
    string.modes = modes;
    string.initial.shape = Pluck{0.5, 3e-3};
    for (int fret = 1; fret <= 5; ++fret) string.contacts.push_back({0.06 * fret, -5e-4, 0, Side::Below});
    string.probes.push_back({Quantity::Displacement, 0.2, 0});
    string.probes.push_back({Quantity::Velocity, 0.2, 0});
    scene.strings.push_back(string);
    return compile(scene).value();
}

struct Scene {
    StringState state;
    std::vector<double> displacement, velocity;
};

/// Violations of a block in which `tamper` was at work before the check.
std::vector<Violation> violations_after(const std::function<void(Scene&)>& tamper,
                                        Metering metering = Metering::Off) {
    const SceneModel model = plucked_over_frets();
    SceneState state = make_state(model, metering);
    StringWatch watch(model.strings[0], state.strings[0], "string");
    Scene scene;
    Judge judge;
    for (int block = 0; block < 10; ++block) {
        watch.begin_block(state.strings[0]);
        scene.displacement.resize(frames);
        scene.velocity.resize(frames);
        for (std::size_t n = 0; n < frames; ++n) {
            render(model, state, std::array{scene.displacement.data() + n, scene.velocity.data() + n}, 1);
            watch.note_frame(state.strings[0]);
        }
    }
    EXPECT_GT(state.strings[0].counters.impulses, 0U);
    scene.state = state.strings[0];
    tamper(scene);
    watch.end_block(scene.state, std::array<std::span<const double>, 2>{scene.displacement, scene.velocity},
                    judge);
    return judge.violations();
}

bool has(const std::vector<Violation>& violations, Invariant invariant) {
    for (const Violation& v : violations) {
        if (v.invariant == invariant) return true;
    }
    return false;
}

TEST(StringWatch, PassesWhatIsSound) {
    EXPECT_TRUE(violations_after([](Scene&) {}).empty());
    EXPECT_TRUE(violations_after([](Scene&) {}, Metering::Step).empty());
}

TEST(StringWatch, SeesEnergyFromNowhere) {
    const auto found = violations_after([](Scene& scene) {
        for (double& v : scene.state.velocity) v *= 1.001;
    });
    EXPECT_TRUE(has(found, Invariant::EnergyRise));
}

TEST(StringWatch, SeesABrokenMeter) {
    const auto found =
        violations_after([](Scene& scene) { scene.state.energy.worst_imbalance = 1e-9; }, Metering::Step);
    EXPECT_TRUE(has(found, Invariant::EnergyBalance));
}

TEST(StringWatch, SeesPenetration) {
    const auto found = violations_after([](Scene& scene) {
        // Through the frets.
        scene.state.displacement[0] -= 2e-3;
    });
    EXPECT_TRUE(has(found, Invariant::Penetration));
    EXPECT_TRUE(has(violations_after([](Scene& scene) { scene.state.counters.worst_penetration_m = 1e-9; }),
                    Invariant::Penetration));
}

TEST(StringWatch, SeesWhatIsNotFinite) {
    const auto found = violations_after(
        [](Scene& scene) { scene.state.velocity[3] = std::numeric_limits<double>::quiet_NaN(); });
    EXPECT_TRUE(has(found, Invariant::Finite));
}

TEST(StringWatch, SeesOutputsBeyondTheirBound) {
    EXPECT_TRUE(has(violations_after([](Scene& scene) { scene.displacement[7] = 0.1; }), Invariant::Output));
    EXPECT_TRUE(has(violations_after([](Scene& scene) { scene.velocity[7] = -1e4; }), Invariant::Output));
}

TEST(StringWatch, SeesPoorAndTruncatedSolves) {
    EXPECT_TRUE(has(violations_after([](Scene& scene) { scene.state.counters.worst_residual_m = 1e-3; }),
                    Invariant::Residual));
    EXPECT_TRUE(has(violations_after([](Scene& scene) { scene.state.counters.truncated_solves = 1; }),
                    Invariant::Truncation));
}

/// Whether a truncated solve of a string with two modes, and contacts on these sides, is a violation.
bool is_to_blame(double first_hz, double second_hz, std::initializer_list<Side> sides) {
    SceneDescription scene;
    scene.output_rate_hz = scene.contact_rate_hz = 48000;
    StringDescription string;
    string.length_m = 0.65;
    string.linear_density_kg_per_m = 0.005;
    string.modes = ModeTable{{first_hz, second_hz}, {0, 0}};
    for (const Side side : sides)
        string.contacts.push_back({0.3, side == Side::Below ? -5e-4 : 5e-4, 0, side});
    scene.strings.push_back(string);
    const SceneModel model = compile(scene).value();
    SceneState state = make_state(model);
    StringWatch watch(model.strings[0], state.strings[0], "string");
    watch.begin_block(state.strings[0]);
    state.strings[0].counters.truncated_solves = 2;
    Judge judge;
    watch.end_block(state.strings[0], {}, judge);
    return has(judge.violations(), Invariant::Truncation);
}

/// 96 kHz is two turns in a step: no impulse moves that mode.
TEST(StringWatch, AsksNoSolutionWhereObstaclesMayContradictOneAnother) {
    EXPECT_TRUE(is_to_blame(100, 200, {Side::Below, Side::Above}));
    EXPECT_TRUE(is_to_blame(100, 95000, {Side::Below, Side::Above}));
    EXPECT_FALSE(is_to_blame(100, 96000, {Side::Below, Side::Above}));
    EXPECT_TRUE(is_to_blame(100, 96000, {Side::Below, Side::Below}));
    EXPECT_FALSE(is_to_blame(96000, 100, {Side::Below, Side::Below}));
}

}  // namespace
}  // namespace jawari::stress
