#include "commands/simulate/row_renderer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/scene/read_scene.h"
#include "jawari/scene/compile.h"
#include "jawari/scene/render.h"
#include "support/scene_text.h"

namespace jawari::host {
namespace {

constexpr std::uint64_t last_row = 1000;

SceneModel model_of(const std::string& text) {
    return compile(read_scene(text, "f").value().description).value();
}

std::vector<std::vector<double>> all_rows(RowRenderer& renderer) {
    std::vector<std::vector<double>> probes(4);
    std::uint64_t next = 0;
    while (!renderer.finished()) {
        const RowBlock& block = renderer.next();
        EXPECT_EQ(block.first, next);
        next += block.count;
        for (std::size_t p = 0; p < probes.size(); ++p)
            probes[p].insert(probes[p].end(), block.probes[p].begin(), block.probes[p].end());
    }
    EXPECT_EQ(next, last_row + 1);
    return probes;
}

TEST(RowRenderer, RowsAreThoseOfTheEngineFrameByFrame) {
    const SceneModel model = model_of(test::valid_scene);
    RowRenderer renderer(model, last_row, Metering::Frame, skip_all, false);
    const auto rows = all_rows(renderer);

    SceneState state = make_state(model, Metering::Frame);
    std::vector<double> values(4);
    std::vector<double*> outputs;
    for (double& value : values) outputs.push_back(&value);
    for (std::uint64_t n = 0; n <= last_row; ++n) {
        render(model, state, outputs, 1);
        for (std::size_t p = 0; p < values.size(); ++p) ASSERT_EQ(rows[p][n], values[p]) << n << " " << p;
    }
}

TEST(RowRenderer, ContactsAndObserversDoNotChangeTheRows) {
    const SceneModel model = model_of(test::valid_scene);
    RowRenderer plain(model, last_row, Metering::Frame, skip_all, false);
    std::uint64_t observed = 0;
    RowRenderer watched(model, last_row, Metering::Frame, skip_all, true,
                        [&](std::uint64_t row, const SceneState& state) {
                            EXPECT_EQ(row, observed++);
                            EXPECT_EQ(state.frame, row);
                        });
    EXPECT_EQ(all_rows(plain), all_rows(watched));
    EXPECT_EQ(observed, last_row + 1);
}

TEST(RowRenderer, TheStateStopsAtTheLastRow) {
    const SceneModel model = model_of(test::valid_scene);
    RowRenderer renderer(model, last_row, Metering::Frame, skip_all, false);
    all_rows(renderer);
    EXPECT_EQ(renderer.state().frame, last_row);
    EXPECT_EQ(renderer.state().strings[0].counters.steps, last_row * 10);
}

TEST(RowRenderer, DroppedContactsAreNotANumber) {
    // A contact at the string's end cannot move it.
    const SceneModel model =
        model_of(test::replaced(test::valid_scene, "\"position_m\": 0.5, \"height_m\": 0.004",
                                "\"position_m\": 0, \"height_m\": 0.004"));
    ASSERT_EQ(model.strings[0].shape->contact_count, 1U);
    RowRenderer renderer(model, 0, Metering::Off, skip_all, true);
    const RowBlock& block = renderer.next();
    EXPECT_EQ(block.count, 1U);
    EXPECT_TRUE(std::isnan(block.strings[0].gap_m[1]));
    EXPECT_EQ(block.strings[0].impulse_Ns[1], 0);
    // The pluck is 2 mm x 0.2/0.3 high over the first contact, which lies 0.5 mm below the rest line.
    EXPECT_NEAR(block.strings[0].gap_m[0], 0.002 * 0.2 / 0.3 + 0.0005, 5e-5);
}

/// Displacements and velocities among the rows that are neither zero nor normal numbers.
std::size_t denormal_rows(const std::vector<std::vector<double>>& rows) {
    std::size_t found = 0;
    for (std::size_t p = 0; p < 2; ++p) {
        for (const double value : rows[p]) found += std::fpclassify(value) == FP_SUBNORMAL ? 1 : 0;
    }
    return found;
}

TEST(RowRenderer, StringsThatDieAwayDoNotPassThroughDenormals) {
    // A pluck near the smallest numbers, 60 dB in 20 ms, and nothing is skipped.
    std::string text = test::replaced(test::valid_scene, "\"height_m\": 0.002", "\"height_m\": 2e-300");
    text = test::replaced(text, "\"t60_s\": 3", "\"t60_s\": 0.02");
    text = test::replaced(text, "\"t60_s\": 1}", "\"t60_s\": 0.02}");
    const SceneModel model = model_of(text);
    RowRenderer renderer(model, last_row, Metering::Off, skip_nothing, false);
    const auto rows = all_rows(renderer);
    EXPECT_NE(rows[0][1], 0);
    EXPECT_EQ(rows[0].back(), 0);
    EXPECT_EQ(denormal_rows(rows), 0U);

    // The engine by itself leaves the processor as it is.
    SceneState state = make_state(model, Metering::Off, skip_nothing);
    std::vector<std::vector<double>> alone(4, std::vector<double>(last_row + 1));
    std::vector<double*> outputs;
    for (auto& probe : alone) outputs.push_back(probe.data());
    render(model, state, outputs, last_row + 1);
    EXPECT_GT(denormal_rows(alone), 0U);
}

}  // namespace
}  // namespace jawari::host
