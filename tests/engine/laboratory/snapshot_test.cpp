// Saved and resumed, a scene goes on as if nothing had been.
#include "jawari/scene/snapshot.h"

#include <random>

#include "laboratory/laboratory.h"

namespace jawari::laboratory {
namespace {

StringDescription busy_string() {
    StringDescription string = unit_string(90);
    std::get<PhysicalModes>(string.modes).damping = DecayTimePoints{{{{0.5, 8}, {20, 2}}}};
    string.initial.shape = Pluck{0.3, 0.02};
    for (const double x : {0.15, 0.4, 0.7}) string.contacts.push_back({x, -0.004, 0.5});
    string.contacts[1].compliance = Compliance{300, 1.5, 0.1, 0};
    FlyingHammer hammer;
    hammer.position_m = 0.6;
    hammer.time_s = 1.1;
    hammer.mass_kg = 0.05;
    hammer.velocity_m_per_s = 0.3;
    hammer.compliance = {2000, 2, 0, 0};
    string.hammers.push_back(hammer);
    std::vector<double> force(3000, 0.0);
    for (std::size_t n = 1400; n < 1500; ++n) force[n] = 0.1;
    string.forces.push_back({0.5, 0, force});
    string.probes = {{Quantity::Displacement, 0.37}, {Quantity::ContactForce, 0, 0}, {Quantity::Energy}};
    return string;
}

std::vector<std::vector<double>> rows(const SceneModel& model, SceneState& state, std::size_t count) {
    std::vector<std::vector<double>> values(model.probe_count, std::vector<double>(count));
    std::vector<double*> outputs;
    for (auto& probe : values) outputs.push_back(probe.data());
    render(model, state, outputs, count);
    return values;
}

SceneModel compiled(const SceneDescription& scene) {
    auto model = compile(scene);
    EXPECT_TRUE(model);
    return std::move(model.value());
}

TEST(Snapshot, GoesOnBitForBitFromAnyFrame) {
    for (const double steps : {1.0, 4.0, 40.0}) {
        for (const bool soft : {false, true}) {
            StringDescription string = busy_string();
            if (!soft) {
                string.contacts[1].compliance.reset();
                string.hammers.clear();
            }
            const SceneModel model = compiled(scene_of(string, 1000, 1000 * steps));
            SceneState whole = make_state(model);
            std::mt19937 random(5);
            for (int i = 0; i < 12; ++i) {
                rows(model, whole, 1 + random() % 300);
                const std::vector<std::uint8_t> bytes = save(model, whole);
                SceneState resumed = make_state(model);
                const auto restored = restore(model, bytes, resumed);
                ASSERT_TRUE(restored);
                EXPECT_EQ(restored.value(), Restored::Exactly);
                SceneState copy = whole;
                EXPECT_EQ(rows(model, copy, 250), rows(model, resumed, 250))
                    << steps << ' ' << soft << ' ' << i;
                EXPECT_EQ(copy.frame, resumed.frame);
                EXPECT_EQ(copy.strings[0].displacement, resumed.strings[0].displacement);
                EXPECT_EQ(copy.strings[0].counters.impulses, resumed.strings[0].counters.impulses);
                EXPECT_EQ(copy.strings[0].counters.flown_frames, resumed.strings[0].counters.flown_frames);
                EXPECT_EQ(copy.strings[0].energy.highest, resumed.strings[0].energy.highest);
            }
        }
    }
}

TEST(Snapshot, AtAnotherRateTheMotionGoesOn) {
    // Free motion is exact at every rate, so a saved and converted state has to meet it again.
    StringDescription string = unit_string(40);
    std::get<PhysicalModes>(string.modes).damping = DecayTimePoints{{{{0.5, 8}, {20, 2}}}};
    string.initial.shape = Pluck{0.3, 0.02};
    string.probes = {{Quantity::Displacement, 0.37}};
    const SceneModel coarse = compiled(scene_of(string, 500, 1000));
    const SceneModel fine = compiled(scene_of(string, 2000, 64000));
    SceneState first = make_state(coarse);
    rows(coarse, first, 321);
    SceneState second = make_state(fine);
    const auto restored = restore(fine, save(coarse, first), second);
    ASSERT_TRUE(restored);
    EXPECT_EQ(restored.value(), Restored::Converted);
    EXPECT_EQ(second.frame, 321U * 4);
    const auto resumed = rows(fine, second, 1000);
    SceneState whole = make_state(fine);
    const auto all = rows(fine, whole, 321 * 4 + 1000);
    for (std::size_t n = 0; n < 1000; ++n) EXPECT_NEAR(resumed[0][n], all[0][321 * 4 + n], 1e-12) << n;
}

TEST(Snapshot, OtherBytesAreRefusedAndChangeNothing) {
    const SceneModel model = compiled(scene_of(busy_string(), 1000, 4000));
    SceneState state = make_state(model);
    rows(model, state, 100);
    const std::vector<std::uint8_t> bytes = save(model, state);
    const std::vector<std::uint8_t> before = bytes;
    std::mt19937 random(9);
    for (int i = 0; i < 300; ++i) {
        std::vector<std::uint8_t> cut(bytes.begin(),
                                      bytes.begin() + static_cast<std::ptrdiff_t>(random() % bytes.size()));
        EXPECT_FALSE(restore(model, cut, state));
    }
    for (int i = 0; i < 300; ++i) {
        std::vector<std::uint8_t> damaged = bytes;
        damaged[random() % damaged.size()] ^= static_cast<std::uint8_t>(1 + random() % 255);
        EXPECT_FALSE(restore(model, damaged, state));
    }
    std::vector<std::uint8_t> longer = bytes;
    longer.push_back(0);
    EXPECT_FALSE(restore(model, longer, state));
    StringDescription other = busy_string();
    other.contacts.pop_back();
    EXPECT_FALSE(restore(compiled(scene_of(other, 1000, 4000)), bytes, state));
    EXPECT_EQ(save(model, state), before);
}

}  // namespace
}  // namespace jawari::laboratory
