// Skipping changes nothing: every frame agrees with uniform stepping to rounding, chaos measured and allowed
// for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/agreement.h"
#include "support/scenes.h"
#include "support/test_names.h"

namespace jawari {
namespace {

using test::distance;
using test::Rendered;
using test::run;

/// Compares with uniform stepping; chaotic scenes by the distribution of many runs.
void expect_same(const SceneDescription& scene, const Skipping& skipping, std::size_t frames,
                 const std::string& what) {
    const auto compiled = compile(scene);
    ASSERT_TRUE(compiled) << compiled.failure().line();
    const test::Agreement found = test::agreement(compiled.value(), skipping, frames);
    EXPECT_TRUE(found.same_steps) << what;
    EXPECT_TRUE(found.same_distribution)
        << what << ": off by " << found.difference << " where uniform runs are by " << found.spread << ", "
        << found.impulses_skipped << " impulses for " << found.impulses;
}

std::size_t frames_of_steps(const SceneDescription& scene, double steps) {
    return static_cast<std::size_t>(std::ceil(steps / (scene.contact_rate_hz / scene.output_rate_hz))) + 1;
}

class SkippingOfLaw : public testing::TestWithParam<ImpactLaw> {};

TEST_P(SkippingOfLaw, AgreesWithUniformSteppingOnRandomScenes) {
    for (std::uint64_t seed = 0; seed < 250 / test::share_of_scenes; ++seed) {
        test::RandomScene random(seed);
        SceneDescription scene = random.scene(GetParam(), 48000, 4e6);
        expect_same(scene, skip_all, frames_of_steps(scene, 12000), "seed " + std::to_string(seed));
    }
}

TEST_P(SkippingOfLaw, AgreesOnABassAtAnyRestitution) {
    for (const double restitution : {0.0, 0.5, 0.9, 1.0}) {
        for (const double rate : {1008000.0, 2016000.0}) {
            SceneDescription scene;
            scene.contact_rate_hz = rate;
            scene.law = GetParam();
            scene.strings.push_back(test::bass_string(862));
            for (auto& contact : scene.strings[0].contacts) contact.restitution = restitution;
            expect_same(scene, skip_all, 480 / test::share_of_scenes,
                        "e " + std::to_string(restitution) + " at " + std::to_string(rate));
        }
    }
}

TEST_P(SkippingOfLaw, AgreesOnNecksWhoseContactsShareBounds) {
    for (std::uint64_t seed = 0; seed < 1 + 11 / test::share_of_scenes; ++seed) {
        test::RandomScene random(seed);
        SceneDescription scene = random.scene(GetParam(), 48000, 1e6);
        StringDescription& string = scene.strings[0];
        const double height = std::get<Pluck>(string.initial.shape).height_m;
        const std::vector<ProfilePoint> profile{{0, -0.05 * height}, {0.7 * string.length_m, -0.8 * height}};
        string.contacts = sampled_neck(string.length_m, random.count(65, 200), profile, random.uniform(0, 1));
        expect_same(scene, skip_all, frames_of_steps(scene, 3000), "seed " + std::to_string(seed));
    }
}

/// Contacts close together, so that impulses push the string into those that were not expected to touch and
/// the frame is solved again with them.
TEST_P(SkippingOfLaw, AgreesOnTheForceOfEachContact) {
    for (std::uint64_t seed = 0; seed < 2 + 18 / test::share_of_scenes; ++seed) {
        test::RandomScene random(seed + 300);
        SceneDescription scene = random.scene(GetParam(), 48000, 1e6);
        StringDescription& string = scene.strings[0];
        const double height = std::get<Pluck>(string.initial.shape).height_m;
        const std::vector<ProfilePoint> profile{{0, -0.05 * height}, {0.7 * string.length_m, -0.8 * height}};
        string.contacts = sampled_neck(string.length_m, 24, profile, 0);
        string.probes.clear();
        for (std::size_t c = 0; c < 24; ++c) string.probes.push_back({Quantity::ContactForce, 0, c});
        expect_same(scene, skip_all, frames_of_steps(scene, 3000), "seed " + std::to_string(seed));
    }
}

TEST_P(SkippingOfLaw, AgreesWithEachSkipAlone) {
    for (std::uint64_t seed = 500; seed < 501 + 19 / test::share_of_scenes; ++seed) {
        test::RandomScene random(seed);
        const SceneDescription scene = random.scene(GetParam(), 48000, 2e6);
        for (const auto& [name, skipping] :
             {std::pair{"flight", Skipping{true, false, false, false, false}},
              std::pair{"certificate", Skipping{false, true, false, false, false}},
              std::pair{"certificate and near", Skipping{false, true, true, false, false}},
              std::pair{"all but flight", Skipping{false, true, true, true, true}},
              std::pair{"all but certificate", Skipping{true, false, true, true, true}},
              std::pair{"all but near", Skipping{true, true, false, true, true}},
              std::pair{"all but lazy", Skipping{true, true, true, false, true}},
              std::pair{"all but sleep", Skipping{true, true, true, true, false}}}) {
            expect_same(scene, skipping, frames_of_steps(scene, 6000),
                        name + (" seed " + std::to_string(seed)));
        }
    }
}

/// Frames of one to three steps, in which a gap that was closed one step before the frame may be open by more
/// than the frame can dip: a law that looks back may still act on it.
TEST_P(SkippingOfLaw, AgreesOnFramesOfFewSteps) {
    for (std::uint64_t seed = 700; seed < 720 + 80 / test::share_of_scenes; ++seed) {
        test::RandomScene random(seed);
        SceneDescription scene = random.scene(GetParam(), 48000, 4e6);
        scene.contact_rate_hz = 48000 * static_cast<double>(1 + seed % 3);
        for (auto& contact : scene.strings[0].contacts) contact.restitution = 1;
        expect_same(scene, skip_all, frames_of_steps(scene, 3000), "seed " + std::to_string(seed));
    }
}

/// A string that lies on the near slope of a bridge and vibrates beyond it: most of the contacts that matter
/// have an impulse at each step, and others are never reached.
SceneDescription lying_on_a_bridge(std::size_t points) {
    SceneDescription scene;
    scene.contact_rate_hz = 960000;
    scene.strings.push_back(test::bass_string(150));
    StringDescription& string = scene.strings[0];
    string.initial.shape = Pluck{0.6 * string.length_m, 1e-3};
    string.contacts.clear();
    for (std::size_t c = 1; c <= points; ++c) {
        const double x = static_cast<double>(c) / static_cast<double>(points + 1);
        const double rise = x < 0.3 ? x / 0.3 * (2 - x / 0.3) : 1 - (x - 0.3) / 0.05;
        string.contacts.push_back({x * string.length_m, 8e-3 * std::max(rise, -10.0), 0, Side::Below});
    }
    return scene;
}

TEST(Skipping, AgreesOnFramesCrowdedWithImpulses) {
    // With bounds for each contact, and with bounds that they share.
    for (const std::size_t points : {60U, 120U}) {
        const SceneDescription scene = lying_on_a_bridge(points);
        expect_same(scene, skip_all, 60, std::to_string(points) + " points");
        const SceneModel model = compile(scene).value();
        SceneState state = make_state(model);
        std::size_t crowded = 0;
        for (std::size_t n = 0; n < 60; ++n) {
            advance_frame(model.strings[0], state.strings[0]);
            crowded += state.strings[0].near_frame.crowded ? 1 : 0;
        }
        EXPECT_GT(crowded, 20U) << points;
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, SkippingOfLaw,
                         testing::Values(ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::Signorini,
                                         ImpactLaw::PaoliSchatzman),
                         test::named);

/// A string excited by a force, as instruments excite it, over frets.
std::vector<double> played(const StringModel& model, const Skipping& skipping, std::size_t frames,
                           Counters& counters, double peak_N = 30) {
    StringState state = make_string_state(model, Metering::Off, skipping);
    std::vector<double> samples;
    for (std::size_t n = 0; n < frames; ++n) {
        const auto force_at = [&](double frame) {
            const double t = frame / 48000;
            return t < 0.004 ? peak_N * t / 0.004 : std::max(0.0, peak_N * (1 - (t - 0.004) / 0.0005));
        };
        const double now = force_at(static_cast<double>(n));
        const double next = force_at(static_cast<double>(n + 1));
        const double rate = (next - now) / static_cast<double>(model.shape->steps_per_frame);
        clear_excitation(state);
        if (now != 0 || next != 0) test::press(model, state, 0.7 * model.shape->length_m, now, rate);
        samples.push_back(probe_value(model, state, 0, 1.0 / 48000));
        advance_frame(model, state);
    }
    counters = state.counters;
    return samples;
}

TEST(Skipping, AgreesWhileAForceActs) {
    SceneDescription scene;
    scene.contact_rate_hz = 1008000;
    scene.strings.push_back(test::bass_string(300));
    scene.strings[0].initial.shape = AtRest{};
    const StringModel model = test::compiled_string(scene);
    Counters skipped, uniform;
    const auto a = played(model, skip_all, 2000, skipped);
    const auto b = played(model, skip_nothing, 2000, uniform);
    EXPECT_GT(uniform.impulses, 100U);
    EXPECT_EQ(skipped.impulses, uniform.impulses);
    EXPECT_LE(distance(a, b), 1e-11);
    EXPECT_LT(skipped.near_frames, 500U);
}

TEST(Skipping, AForceThatLeavesTheStringClearIsNotMistakenForContact) {
    SceneDescription scene;
    scene.contact_rate_hz = 1008000;
    scene.strings.push_back(test::bass_string(862));
    scene.strings[0].initial.shape = AtRest{};
    const StringModel model = test::compiled_string(scene);
    Counters skipped;
    played(model, skip_all, 400, skipped,
           1.0);  // lifts the string by about 1 mm, over frets 1 to 2 mm below it
    EXPECT_EQ(skipped.impulses, 0U);
    EXPECT_EQ(skipped.near_frames, 0U);
}

/// Forces at several points that change in every frame, stop and start again, on strings over obstacles.
std::vector<double> pushed_about(const StringModel& model, const Skipping& skipping, std::uint64_t seed,
                                 std::size_t frames, Counters& counters) {
    test::RandomScene random(seed);
    StringState state = make_string_state(model, Metering::Off, skipping);
    std::vector<double> samples;
    const double strength_N = random.logarithmic(0.01, 3);
    for (std::size_t n = 0; n < frames; ++n) {
        clear_excitation(state);
        if (n / 40 % 3 != 2) {
            for (int point = 0; point < 2; ++point) {
                const double force_N = strength_N * random.uniform(-1, 1);
                const double rate_N =
                    strength_N * random.uniform(-1, 1) / static_cast<double>(model.shape->steps_per_frame);
                const AlignedVector<double> row =
                    test::shape_row(model, random.uniform(0.1, 0.9) * model.shape->length_m);
                add_force(state, row.data(), model.shape->stride, force_N, rate_N);
            }
        }
        samples.push_back(probe_value(model, state, 0, 1.0 / 48000));
        advance_frame(model, state);
    }
    counters = state.counters;
    return samples;
}

TEST_P(SkippingOfLaw, AgreesWhileRandomForcesActAndStop) {
    for (std::uint64_t seed = 0; seed < 1 + 19 / test::share_of_scenes; ++seed) {
        test::RandomScene random(seed + 7000);
        SceneDescription scene = random.scene(GetParam(), 48000, 1e6);
        for (auto& contact : scene.strings[0].contacts) contact.restitution = 0;  // not chaotic
        const StringModel model = test::compiled_string(scene);
        Counters skipped, uniform;
        const auto a = pushed_about(model, skip_all, seed, 240, skipped);
        const auto b = pushed_about(model, skip_nothing, seed, 240, uniform);
        EXPECT_LE(distance(a, b), 1e-10) << "seed " << seed;
        EXPECT_EQ(skipped.steps, uniform.steps);
    }
}

TEST(Skipping, StringsFallAsleepAndWake) {
    SceneDescription scene;
    scene.contact_rate_hz = 96000;
    scene.strings.push_back(test::bass_string(20));
    scene.strings[0].initial.shape = AtRest{};
    auto& modes = std::get<PhysicalModes>(scene.strings[0].modes);
    modes.damping = DecayTimePoints{{{{100, 0.05}, {1000, 0.05}}}};
    const StringModel model = test::compiled_string(scene);
    StringState state = make_string_state(model);
    for (int round = 0; round < 2; ++round) {
        test::press(model, state, 0.2 * model.shape->length_m, 1);
        advance_frame(model, state);
        clear_excitation(state);
        EXPECT_FALSE(state.asleep);
        const double begin_J = energy(model, state);
        EXPECT_GT(begin_J, 0);
        double last_J = begin_J;
        for (int n = 0; n < 24000; ++n) {  // 60 dB every 2400 frames
            advance_frame(model, state);
            if (!state.asleep) last_J = energy(model, state);
        }
        EXPECT_TRUE(state.asleep);
        EXPECT_EQ(energy(model, state), 0);
        EXPECT_LT(last_J, 1e-38 * begin_J);  // 400 dB, but for what bounds exceed
        EXPECT_GT(last_J, 1e-44 * begin_J);
    }
}

TEST(Skipping, WorkFollowsWhatTouches) {
    SceneDescription scene;
    scene.strings.push_back(test::bass_string(862));
    const SceneModel model = compile(scene).value();
    const Rendered skipped = run(model, skip_all, 4800);
    const Rendered uniform = run(model, skip_nothing, 4800);
    EXPECT_EQ(skipped.counters.impulses, uniform.counters.impulses);
    EXPECT_LT(skipped.counters.near_frames, 480U);
    EXPECT_LT(skipped.counters.candidates, uniform.counters.candidates / 50);
}

}  // namespace
}  // namespace jawari
