// Skipping changes nothing: every frame agrees with uniform stepping to rounding, chaos measured and allowed
// for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes.h"

namespace jawari {
namespace {

struct Rendered {
    std::vector<double> samples;
    Counters counters;
};

Rendered run(const SceneModel& model, const Skipping& skipping, std::size_t frames,
             std::uint64_t perturbation_seed = 0) {
    SceneState state = make_state(model, Metering::Off, skipping);
    if (perturbation_seed != 0) {  // by half a rounding error up or down
        test::RandomScene random(perturbation_seed);
        for (double& q : state.strings[0].displacement)
            q *= random.count(0, 1) == 0 ? 1 - 1.2e-16 : 1 + 2.3e-16;
        notice_change(model.strings[0], state.strings[0]);
    }
    Rendered result;
    std::vector<std::vector<double>> signals(model.probe_count, std::vector<double>(frames));
    std::vector<double*> outputs;
    for (auto& signal : signals) outputs.push_back(signal.data());
    render(model, state, outputs, frames);
    for (const auto& signal : signals)
        result.samples.insert(result.samples.end(), signal.begin(), signal.end());
    result.counters = state.strings[0].counters;
    return result;
}

double largest(const std::vector<double>& samples) {
    double peak = 0;
    for (const double x : samples) peak = std::max(peak, std::abs(x));
    return peak;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst / std::max(largest(b), 1e-300);
}

/// Compares with uniform stepping as closely as rounding lets two uniform runs agree.
void expect_same(const SceneDescription& scene, const Skipping& skipping, std::size_t frames,
                 const std::string& what) {
    const auto compiled = compile(scene);
    ASSERT_TRUE(compiled) << compiled.failure().line();
    const SceneModel& model = compiled.value();
    const Rendered uniform = run(model, skip_nothing, frames);
    const Rendered skipped = run(model, skipping, frames);
    double sensitivity = 0;
    std::uint64_t impulse_spread = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Rendered perturbed = run(model, skip_nothing, frames, seed);
        sensitivity = std::max(sensitivity, distance(perturbed.samples, uniform.samples));
        const auto [fewer, more] = std::minmax(perturbed.counters.impulses, uniform.counters.impulses);
        impulse_spread = std::max(impulse_spread, more - fewer);
    }
    EXPECT_LE(distance(skipped.samples, uniform.samples), std::max(1e-11, 100 * sensitivity)) << what;
    EXPECT_EQ(skipped.counters.steps, uniform.counters.steps) << what;
    if (sensitivity < 1e-9) {
        // Uniform runs differ among themselves by impulses at the edge of rounding (a resting contact that
        // just lifts).
        EXPECT_NEAR(static_cast<double>(skipped.counters.impulses),
                    static_cast<double>(uniform.counters.impulses), static_cast<double>(2 * impulse_spread))
            << what;
    }
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

TEST_P(SkippingOfLaw, AgreesOnThePublishedBassAtAnyRestitution) {
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

INSTANTIATE_TEST_SUITE_P(Laws, SkippingOfLaw,
                         testing::Values(ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::Signorini,
                                         ImpactLaw::PaoliSchatzman));

/// A string excited by a force, as instruments excite it, over frets.
std::vector<double> played(const StringModel& model, const Skipping& skipping, std::size_t frames,
                           Counters& counters) {
    StringState state = make_string_state(model, Metering::Off, skipping);
    std::vector<double> samples;
    const double peak_N = 30;
    for (std::size_t n = 0; n < frames; ++n) {
        const auto force_at = [&](double frame) {
            const double t = frame / 48000;
            return t < 0.004 ? peak_N * t / 0.004 : std::max(0.0, peak_N * (1 - (t - 0.004) / 0.0005));
        };
        const double now = force_at(static_cast<double>(n));
        const double next = force_at(static_cast<double>(n + 1));
        const double rate = (next - now) / static_cast<double>(model.steps_per_frame);
        clear_excitation(state);
        if (now != 0 || next != 0) test::press(model, state, 0.7 * model.length_m, now, rate);
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
        test::press(model, state, 0.2 * model.length_m, 1);
        advance_frame(model, state);
        clear_excitation(state);
        EXPECT_FALSE(state.asleep);
        EXPECT_GT(energy(model, state), 0);
        for (int n = 0; n < 24000; ++n) advance_frame(model, state);  // 60 dB every 2400 frames
        EXPECT_TRUE(state.asleep);
        EXPECT_EQ(energy(model, state), 0);
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
