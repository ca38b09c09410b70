// Block render: the same numbers however they are asked for, at the times and in the units promised.
#include "jawari/scene/render.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/scenes.h"
#include "support/test_names.h"

namespace jawari {
namespace {

std::vector<std::vector<double>> rendered(const SceneModel& model, SceneState& state, std::size_t frames,
                                          std::size_t block) {
    std::vector<std::vector<double>> samples(model.probe_count, std::vector<double>(frames));
    for (std::size_t done = 0; done < frames; done += block) {
        std::vector<double*> outputs;
        for (auto& probe : samples) outputs.push_back(probe.data() + done);
        render(model, state, outputs, std::min(block, frames - done));
    }
    return samples;
}

SceneModel probed_scene(ImpactLaw law) {
    test::RandomScene random(31);
    SceneDescription scene = random.scene(law, 400000, 600000);
    scene.strings.push_back(random.string());
    for (auto& string : scene.strings) {
        string.probes = {{Quantity::Displacement, 0.4 * string.length_m, 0},
                         {Quantity::Velocity, 0.8 * string.length_m, 0},
                         {Quantity::ContactForce, 0, string.contacts.size() - 1},
                         {Quantity::ContactForce, 0, 0},
                         {Quantity::Energy, 0, 0}};
    }
    auto model = compile(scene);
    EXPECT_TRUE(model.ok());
    return model.value();
}

class BlockSize : public testing::TestWithParam<ImpactLaw> {};

TEST_P(BlockSize, DoesNotChangeABit) {
    const SceneModel model = probed_scene(GetParam());
    SceneState reference = make_state(model);
    const auto expected = rendered(model, reference, 1500, 1);
    for (const std::size_t block : {17U, 64U, 1024U, 1500U}) {
        SceneState state = make_state(model);
        EXPECT_EQ(rendered(model, state, 1500, block), expected) << block;
        EXPECT_EQ(state.frame, 1500U);
        EXPECT_EQ(state.strings[1].counters.impulses, reference.strings[1].counters.impulses);
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, BlockSize,
                         testing::Values(ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::Signorini,
                                         ImpactLaw::PaoliSchatzman),
                         test::named);

/// A string of a fretted instrument at live quality that is pressed down, lies on its frets, rings, fades
/// within a few hundred frames or rests.
StringDescription live_string(std::size_t kind) {
    StringDescription string = test::bass_string(110);
    const std::array<double, 5> heights{-2.33e-3, 0.4e-3, -2.33e-3, -4e-3, -1e-3};
    for (auto& fret : string.contacts) fret.height_m = std::max(fret.height_m, heights[kind]);
    if (kind == 0) string.contacts.push_back({0.25, -2e-3, 0, Side::Above});
    if (kind == 3) {
        auto& modes = std::get<PhysicalModes>(string.modes);
        modes.tension_N *= 16;  // high enough for such losses
        modes.damping = DecayTimePoints{{{{100, 3e-3}, {1000, 3e-3}}}};
        string.initial.shape = Pluck{0.5, 1e-3};
    }
    if (kind == 4) string.initial.shape = AtRest{};
    return string;
}

SceneModel live_scene(const std::vector<std::size_t>& kinds) {
    SceneDescription scene;
    scene.contact_rate_hz = 192000;
    for (const std::size_t kind : kinds) scene.strings.push_back(live_string(kind));
    return compile(scene).value();
}

TEST(Render, BitsOfLiveStringsDependNeitherOnBlocksNorOnStringsThatSleep) {
    const std::size_t frames = 3072;
    const SceneModel all = live_scene({4, 0, 3, 1, 4, 2, 3});
    SceneState reference = make_state(all);
    const auto expected = rendered(all, reference, frames, 1);
    std::size_t asleep = 0;
    for (const StringState& string : reference.strings) asleep += string.asleep ? 1 : 0;
    EXPECT_EQ(asleep, 4U);
    EXPECT_GT(reference.strings[1].counters.near_frames, 3000U);
    EXPECT_GT(reference.strings[5].counters.flown_frames, 1000U);
    for (const std::size_t block : {17U, 64U, 1024U}) {
        SceneState state = make_state(all);
        EXPECT_EQ(rendered(all, state, frames, block), expected) << block;
    }
    const SceneModel awake = live_scene({0, 1, 2});  // without the sleepers
    for (const std::size_t block : {17U, 64U, 1024U}) {
        SceneState state = make_state(awake);
        const auto alone = rendered(awake, state, frames, block);
        EXPECT_EQ(alone[0], expected[1]) << block;
        EXPECT_EQ(alone[1], expected[3]) << block;
        EXPECT_EQ(alone[2], expected[5]) << block;
    }
}

TEST(Render, AStringPutBackToItsStartRendersTheSameBits) {
    const SceneModel model = live_scene({0, 1, 2});
    SceneState state = make_state(model);
    const auto expected = rendered(model, state, 500, 64);
    for (std::size_t s = 0; s < 3; ++s) reset(model.strings[s], state.strings[s]);
    EXPECT_EQ(rendered(model, state, 500, 64), expected);
}

TEST(Render, RowNIsTheTimeNOverTheRate) {
    // One undamped mode of 100 Hz: q = cos(omega t), exactly, at each output time, for any number of steps
    // between.
    for (const double contact_rate : {48000.0, 96000.0, 2016000.0}) {
        StringDescription string;
        string.length_m = 2;
        string.linear_density_kg_per_m = 1;
        string.modes = ModeTable{{100}, {0}};
        string.initial.shape = ModalState{{1e-3}, {}};
        string.probes = {
            {Quantity::Displacement, 1.0, 0}, {Quantity::Velocity, 1.0, 0}, {Quantity::Energy, 0, 0}};
        SceneDescription scene;
        scene.output_rate_hz = 48000;
        scene.contact_rate_hz = contact_rate;
        scene.strings.push_back(string);
        const SceneModel model = compile(scene).value();
        SceneState state = make_state(model);
        const auto samples = rendered(model, state, 2000, 100);
        const double omega = 2 * std::numbers::pi * 100;
        const double h = 1 / contact_rate;
        const double initial = samples[2][0];
        for (int n = 0; n < 2000; ++n) {
            const double t = n / 48000.0;
            const double now = 1e-3 * std::cos(omega * t);
            ASSERT_NEAR(samples[0][static_cast<std::size_t>(n)], now, 1e-14) << n;
            const double backward = (now - 1e-3 * std::cos(omega * (t - h))) / h;  // over a contact step
            ASSERT_NEAR(samples[1][static_cast<std::size_t>(n)], backward, 1e-10) << n;
            ASSERT_NEAR(samples[2][static_cast<std::size_t>(n)], initial, 1e-12 * initial) << n;
        }
        // H of the exact scheme tends to the true energy, 1/2 mu omega^2 q^2.
        EXPECT_NEAR(initial, 0.5 * omega * omega * 1e-6, 0.5 * omega * omega * 1e-6 * omega * omega * h * h);
    }
}

TEST(Render, ContactForceAddsUpToTheImpulseGiven) {
    // Newton's second law for the whole string: its momentum changes by what frets give and its two ends
    // take.
    SceneDescription scene;
    scene.contact_rate_hz = 480000;
    scene.strings.push_back(test::bass_string(150));
    for (std::size_t c = 0; c < 20; ++c) scene.strings[0].probes.push_back({Quantity::ContactForce, 0, c});
    const SceneModel model = compile(scene).value();
    SceneState state = make_state(model, Metering::Off, skip_nothing);
    const std::size_t frames = 1200;
    const auto samples = rendered(model, state, frames, 64);

    // The same scene step by step, adding up every impulse.
    StringState stepped = make_string_state(model.strings[0], Metering::Off, skip_nothing);
    std::vector<double> impulse(20, 0.0);
    for (std::size_t n = 0; n + 1 < frames; ++n) {
        for (std::size_t i = 0; i < model.steps_per_frame; ++i) {
            step(model.strings[0], stepped);
            for (std::size_t c = 0; c < 20; ++c) impulse[c] += stepped.contact.impulse[c];
        }
    }
    double largest = 0;
    for (std::size_t c = 0; c < 20; ++c) {
        EXPECT_EQ(samples[1 + c][0], 0);
        double sum = 0;
        for (const double force : samples[1 + c]) {
            EXPECT_GE(force, 0);
            sum += force / 48000;
        }
        EXPECT_NEAR(sum, impulse[c], 1e-6 * (impulse[c] + 1e-9)) << "fret " << c + 1;
        largest = std::max(largest, sum);
    }
    EXPECT_GT(largest, 1e-5);
}

TEST(Render, ForceOfADroppedContactIsZero) {
    SceneDescription scene;
    scene.strings.push_back(test::bass_string(20));
    scene.strings[0].contacts.insert(scene.strings[0].contacts.begin(), {0.0, -1e-3, 0, Side::Below});
    scene.strings[0].probes = {{Quantity::ContactForce, 0, 0}};
    const SceneModel model = compile(scene).value();
    SceneState state = make_state(model);
    const auto samples = rendered(model, state, 500, 50);
    for (const double force : samples[0]) EXPECT_EQ(force, 0);
}

TEST(Render, NoFramesNoProbesNoHarm) {
    SceneDescription scene;
    scene.strings.push_back(test::bass_string(20));
    scene.strings[0].probes.clear();
    const SceneModel model = compile(scene).value();
    EXPECT_EQ(model.probe_count, 0U);
    SceneState state = make_state(model);
    render(model, state, {}, 0);
    EXPECT_EQ(state.frame, 0U);
    render(model, state, {}, 3);
    EXPECT_EQ(state.frame, 3U);
}

}  // namespace
}  // namespace jawari
