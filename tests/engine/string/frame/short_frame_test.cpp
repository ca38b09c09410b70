// Short frames change nothing: they agree with uniform stepping on strings that are held, pressed, plucked
// and driven, and hand their gaps on to the certificate.
#include "string/frame/short_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/agreement.h"
#include "support/scenes.h"

namespace jawari {
namespace {

/// A random string at a live contact rate, its obstacles near enough to be struck all the time.
SceneDescription live_scene(std::uint64_t seed) {
    test::RandomScene random(seed);
    SceneDescription scene = random.scene(ImpactLaw::Signorini, 48000, 400000);
    StringDescription& string = scene.strings[0];
    const double height = std::get<Pluck>(string.initial.shape).height_m;
    for (auto& contact : string.contacts) {
        if (contact.side == Side::Below) contact.height_m *= random.uniform(0, 0.3);
    }
    if (seed % 3 == 0) {  // pressed down between two frets
        string.contacts.push_back(
            {string.length_m * random.uniform(0.2, 0.8), -0.3 * height, 0, Side::Above});
    }
    while (string.contacts.size() > 32) string.contacts.pop_back();
    scene.contact_rate_hz = std::min(scene.contact_rate_hz, 48000.0 * 8);
    return scene;
}

TEST(ShortFrames, AgreeWithUniformStepping) {
    std::size_t near = 0;
    for (std::uint64_t seed = 0; seed < 1 + 150 / test::share_of_scenes; ++seed) {
        const auto compiled = compile(live_scene(seed));
        if (!compiled) continue;  // pressed against an obstacle that is too close
        const SceneModel& model = compiled.value();
        ASSERT_TRUE(has_short_frames(model.strings[0])) << seed;
        const test::Agreement found = test::agreement(model, skip_all, 600);
        EXPECT_TRUE(found.same_steps) << seed;
        EXPECT_TRUE(found.same_distribution) << seed << ": off by " << found.difference << ", "
                                             << found.impulses_skipped << " impulses for " << found.impulses;
        near += found.impulses;
    }
    EXPECT_GT(near, 10000U);
}

/// A force that comes and goes, over a string that lies on its frets.
std::vector<double> driven(const StringModel& model, const Skipping& skipping, std::uint64_t seed,
                           Counters& counters) {
    test::RandomScene random(seed);
    StringState state = make_string_state(model, Metering::Off, skipping);
    std::vector<double> samples;
    const double x = random.uniform(0.1, 0.9) * model.shape->length_m;
    double force = 0;
    for (int n = 0; n < 500; ++n) {
        clear_excitation(state);
        const double next = n % 120 < 70 ? random.uniform(-3, 1) : 0;
        const double rate = (next - force) / static_cast<double>(model.shape->steps_per_frame);
        if (force != 0 || next != 0) test::press(model, state, x, force, rate);
        force = next;
        samples.push_back(probe_value(model, state, 0, 1.0 / 48000));
        advance_frame(model, state);
    }
    counters = state.counters;
    return samples;
}

TEST(ShortFrames, AgreeWhileForcesComeAndGo) {
    for (std::uint64_t seed = 0; seed < 1 + 20 / test::share_of_scenes; ++seed) {
        SceneDescription scene = live_scene(3 * seed + 1);
        scene.strings[0].initial.shape = AtRest{};
        const StringModel model = test::compiled_string(scene);
        Counters skipped, uniform;
        const auto a = driven(model, skip_all, seed, skipped);
        const auto b = driven(model, skip_nothing, seed, uniform);
        EXPECT_LE(test::distance(a, b), 1e-10) << seed;
        EXPECT_EQ(skipped.steps, uniform.steps);
        EXPECT_GT(skipped.near_frames + skipped.flown_frames, 0U);
    }
}

/// A string that touches a fret at 0.2 m under a weak force. In the frame after the first look, which is
/// solved without looking, it is pulled off there and pushed towards a fret at 0.5 m, which it reaches two
/// frames later.
std::vector<double> struck_unlooked(const StringModel& model, const Skipping& skipping, Counters& counters) {
    StringState state = make_string_state(model, Metering::Off, skipping);
    const AlignedVector<double> touching = test::shape_row(model, 0.2), near = test::shape_row(model, 0.5);
    std::vector<double> samples;
    for (int n = 0; n < 40; ++n) {
        clear_excitation(state);
        const double strength = n == 1 ? 60 : 1e-6;
        add_force(state, touching.data(), model.shape->stride, strength);
        add_force(state, near.data(), model.shape->stride, -strength);
        samples.push_back(probe_value(model, state, 0, 1.0 / 48000));
        advance_frame(model, state);
    }
    counters = state.counters;
    return samples;
}

TEST(ShortFrames, BoundsKnowWhatForcesDidInFramesThatWereNotLookedAt) {
    SceneDescription scene;
    scene.output_rate_hz = 48000;
    scene.contact_rate_hz = 192000;
    StringDescription string;
    string.length_m = 0.7;
    string.linear_density_kg_per_m = 0.005;
    PhysicalModes modes;
    modes.count = 60;
    modes.tension_N = 80;
    string.modes = modes;
    string.contacts = {{0.2, 0, 0, Side::Below}, {0.5, -4e-4, 0, Side::Below}};
    string.probes.push_back({Quantity::Displacement, 0.5, 0});
    scene.strings.push_back(string);
    const StringModel model = test::compiled_string(scene);
    ASSERT_TRUE(has_short_frames(model));
    Counters skipped, uniform;
    const auto a = struck_unlooked(model, skip_all, skipped);
    const auto b = struck_unlooked(model, skip_nothing, uniform);
    EXPECT_LE(test::distance(a, b), 1e-10);
    EXPECT_EQ(skipped.impulses, uniform.impulses);
    EXPECT_LE(*std::min_element(b.begin(), b.end()), -3.9e-4);  // there
}

TEST(ShortFrames, GapsStayThoseOfTheModes) {
    // Gaps go on from frame to frame; a thousand frames of permanent contact do not let them drift.
    SceneDescription scene;
    scene.contact_rate_hz = 192000;
    scene.strings.push_back(test::bass_string(110));
    scene.strings[0].contacts.push_back({0.3, -2.2e-3, 0, Side::Above});
    const StringModel model = test::compiled_string(scene);
    StringState state = make_string_state(model);
    for (int n = 0; n < 1000; ++n) {
        advance_frame(model, state);
        ASSERT_EQ(state.short_frame.gaps_at, state.frame) << n;
        for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
            long double gap = -model.shape->contact_height[c];
            for (std::size_t k = 0; k < model.shape->mode_count; ++k)
                gap += static_cast<long double>(model.shape->contact_rows[c * model.shape->stride + k]) *
                       state.displacement[k];
            ASSERT_NEAR(state.contact.gap[c], static_cast<double>(gap), 1e-16)
                << "frame " << n << " contact " << c;
        }
    }
    EXPECT_EQ(state.counters.near_frames, 1000U);
}

TEST(ShortFrames, AreForFewContactsAndSteps) {
    const auto is_short = [](std::size_t contacts, double contact_rate_hz, ImpactLaw law) {
        SceneDescription scene;
        scene.contact_rate_hz = contact_rate_hz;
        scene.law = law;
        scene.strings.push_back(test::bass_string(50));
        const std::vector<ProfilePoint> profile{{0, -1e-3}};
        scene.strings[0].contacts = sampled_neck(0.863, contacts, profile, 0);
        return has_short_frames(test::compiled_string(scene));
    };
    EXPECT_TRUE(is_short(22, 480000, ImpactLaw::Signorini));
    EXPECT_TRUE(is_short(60, 192000, ImpactLaw::Signorini));
    EXPECT_FALSE(is_short(22, 528000, ImpactLaw::Signorini));
    EXPECT_FALSE(is_short(80, 48000, ImpactLaw::Signorini));
    EXPECT_FALSE(is_short(22, 192000, ImpactLaw::Newton));
}

}  // namespace
}  // namespace jawari
