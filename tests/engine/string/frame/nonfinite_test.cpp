// A state that is not finite is caught, counted and put to rest, and stays where it arose.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "jawari/jawari.h"
#include "support/scenes.h"
#include "support/test_names.h"

namespace jawari {
namespace {

SceneModel three_strings(ImpactLaw law) {
    SceneDescription scene;
    scene.contact_rate_hz = 192000;
    scene.law = law;
    for (int i = 0; i < 3; ++i) scene.strings.push_back(test::bass_string(60));
    scene.strings[2].initial.shape = Pluck{0.5, 0.002};
    return compile(scene).value();
}

std::vector<std::vector<double>> rendered(const SceneModel& model, SceneState& state, std::size_t frames) {
    std::vector<std::vector<double>> samples(model.probe_count, std::vector<double>(frames));
    std::vector<double*> outputs;
    for (auto& probe : samples) outputs.push_back(probe.data());
    render(model, state, outputs, frames);
    return samples;
}

struct Injury {
    std::string name;
    std::function<void(const StringModel&, StringState&, double)> inflict;
    bool signorini_only = false;
};

const std::vector<Injury>& injuries() {
    static const std::vector<Injury> all{
        {"displacement",
         [](const StringModel& model, StringState& state, double bad) {
             state.displacement[7] = bad;
             notice_change(model, state);
         }},
        {"velocity",
         [](const StringModel& model, StringState& state, double bad) {
             state.velocity[59] = bad;
             notice_change(model, state);
         }},
        {"force", [](const StringModel& model, StringState& state,
                     double bad) { test::press(model, state, 0.2, bad); }},
        {"force_rate", [](const StringModel& model, StringState& state,
                          double bad) { test::press(model, state, 0.2, 1e-3, bad); }},
        {"height",
         [](const StringModel& model, StringState& state, double bad) {
             move_contact(model, state, 4, bad, 3);
         },
         true},
    };
    return all;
}

class NonFinite : public testing::TestWithParam<std::tuple<ImpactLaw, double>> {};

TEST_P(NonFinite, IsCaughtCountedAndNeverSpread) {
    const auto [law, bad] = GetParam();
    const SceneModel model = three_strings(law);
    SceneState healthy = make_state(model);
    const auto expected = rendered(model, healthy, 400);
    for (const Injury& injury : injuries()) {
        // Only this law pushes with all it takes, and only if the obstacle is infinitely high.
        if (injury.signorini_only && (law != ImpactLaw::Signorini || bad != HUGE_VAL)) continue;
        SCOPED_TRACE(injury.name + " = " + std::to_string(bad));
        SceneState state = make_state(model);
        auto before = rendered(model, state, 100);
        injury.inflict(model.strings[1], state.strings[1], bad);
        const auto after = rendered(model, state, 300);
        // Caught within a frame or two; the string rests, and its output is finite from the next frame
        // on.
        EXPECT_GE(state.strings[1].counters.nonfinite_resets, 1U);
        EXPECT_LE(state.strings[1].counters.nonfinite_resets, 2U);
        for (std::size_t n = 3; n < 300; ++n) ASSERT_TRUE(std::isfinite(after[1][n])) << n;
        EXPECT_NEAR(after[1][299], 0, 1e-12);
        EXPECT_FALSE(state.strings[1].excitation.active);
        // The others do not notice.
        for (const std::size_t other : {0U, 2U}) {
            EXPECT_EQ(state.strings[other].counters.nonfinite_resets, 0U);
            for (std::size_t n = 0; n < 300; ++n) ASSERT_EQ(after[other][n], expected[other][100 + n]) << n;
        }
        // And the string plays again.
        reset(model.strings[1], state.strings[1]);
        EXPECT_EQ(state.strings[1].counters.nonfinite_resets, 0U);
        EXPECT_EQ(rendered(model, state, 200)[1],
                  std::vector<double>(expected[1].begin(), expected[1].begin() + 200));
    }
}

constexpr ImpactLaw all_laws[] = {ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::Signorini,
                                  ImpactLaw::PaoliSchatzman};

INSTANTIATE_TEST_SUITE_P(NaN, NonFinite,
                         testing::Combine(testing::ValuesIn(all_laws), testing::Values(std::nan(""))),
                         test::named);
INSTANTIATE_TEST_SUITE_P(Infinity, NonFinite,
                         testing::Combine(testing::ValuesIn(all_laws), testing::Values(HUGE_VAL, -HUGE_VAL)),
                         test::named);

}  // namespace
}  // namespace jawari
