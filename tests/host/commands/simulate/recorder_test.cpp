#include "commands/simulate/recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formats/scene/read_scene.h"
#include "jawari/scene/compile.h"
#include "support/scene_text.h"

namespace jawari::host {
namespace {

struct Compiled {
    Scene scene;
    SceneModel model;
};

Compiled compiled() {
    auto scene = read_scene(test::valid_scene, "dir/f.json");
    auto model = compile(scene.value().description);
    return {std::move(scene.value()), std::move(model.value())};
}

/// `rows` rows of one probe (the others zero) and one contact's impulse, as functions of the row.
template <class Probe, class Impulse>
void feed(Recorder& recorder, std::uint64_t rows, Probe probe, Impulse impulse) {
    for (std::uint64_t first = 0; first < rows;) {
        RowBlock block;
        block.first = first;
        block.count = std::min<std::uint64_t>(100, rows - first);
        block.probes.assign(4, std::vector<double>(block.count));
        block.strings.resize(1);
        for (std::size_t i = 0; i < block.count; ++i) {
            block.probes[0][i] = probe(first + i);
            block.strings[0].impulse_Ns.push_back(0);
            block.strings[0].impulse_Ns.push_back(impulse(first + i));
        }
        recorder.add(block);
        first += block.count;
    }
}

TEST(Recorder, ShortRecordingsAreKeptAsTheyAre) {
    const Compiled c = compiled();
    Recorder recorder(c.scene, c.model, probe_labels(c.scene.description), 80);
    feed(
        recorder, 81, [](auto row) { return std::sin(static_cast<double>(row)); },
        [](auto row) { return row % 40 == 1 ? 0.25 : 0.0; });
    const SceneRecording& recording = recorder.recording();
    EXPECT_EQ(recording.title, "f");
    EXPECT_EQ(recording.duration_s, 0.01);
    EXPECT_EQ(recording.interval_s, 1.0 / 8000);
    ASSERT_EQ(recording.times_s.size(), 81U);
    const StringRecording& string = recording.strings.at(0);
    ASSERT_EQ(string.probes.size(), 4U);
    EXPECT_EQ(string.probes[1].unit, "m/s");
    for (std::size_t n = 0; n < 81; ++n) {
        EXPECT_EQ(recording.times_s[n], static_cast<double>(n) / 8000);
        EXPECT_EQ(string.probes[0].values[n], std::sin(static_cast<double>(n)));
    }
    ASSERT_EQ(string.events.size(), 2U);
    EXPECT_EQ(string.events[1].time_s, 41.0 / 8000);
    EXPECT_EQ(string.events[1].contact, 1U);
    EXPECT_EQ(string.events[1].impulse_Ns, 0.25);
    ASSERT_EQ(string.obstacles.size(), 2U);
    EXPECT_EQ(string.obstacles[1].side, Side::Above);
}

TEST(Recorder, LongRecordingsKeepTheEnvelopeAndEveryImpulse) {
    const Compiled c = compiled();
    const std::uint64_t rows = 5 * recording_rows + 3;
    Recorder recorder(c.scene, c.model, probe_labels(c.scene.description), rows - 1);
    // A spike up and a spike down, each one row long, and an impulse in every row.
    feed(
        recorder, rows, [](auto row) { return row == 777777   ? 5.0
                                              : row == 123456 ? -3.0
                                                              : 0.0; },
        [](auto) { return 0.5; });
    const SceneRecording& recording = recorder.recording();
    const StringRecording& string = recording.strings.at(0);
    EXPECT_LE(recording.times_s.size(), recording_rows + 2);
    EXPECT_EQ(recording.times_s.size(), string.probes[0].values.size());
    EXPECT_TRUE(std::is_sorted(recording.times_s.begin(), recording.times_s.end()));
    EXPECT_EQ(recording.times_s.back(), static_cast<double>(rows - 1) / 8000);
    const auto [lowest, highest] =
        std::minmax_element(string.probes[0].values.begin(), string.probes[0].values.end());
    EXPECT_EQ(*lowest, -3);
    EXPECT_EQ(*highest, 5);
    const auto spike = static_cast<std::size_t>(highest - string.probes[0].values.begin());
    EXPECT_NEAR(recording.times_s[spike], 777777.0 / 8000, recording.interval_s);
    double sum = 0;
    for (const ContactEvent& event : string.events) sum += event.impulse_Ns;
    EXPECT_EQ(sum, 0.5 * static_cast<double>(rows));
}

TEST(Recorder, SnapshotsShowTheStringOverItsFirstPeriod) {
    const Compiled c = compiled();
    const std::uint64_t last_row = 800;
    Recorder recorder(c.scene, c.model, {}, last_row);
    RowRenderer renderer(c.model, last_row, Metering::Off, skip_all, true,
                         [&](std::uint64_t row, const SceneState& state) { recorder.observe(row, state); });
    while (!renderer.finished()) renderer.next();
    const StringRecording& string = recorder.recording().strings.at(0);
    ASSERT_EQ(string.snapshots.size(), 9U);
    EXPECT_EQ(string.snapshots[0].time_s, 0);
    const double period_s = 1.6 / std::sqrt(100 / 0.005);
    EXPECT_NEAR(string.snapshots[8].time_s, period_s, 1.0 / 8000);
    EXPECT_EQ(string.grid_m.front(), 0);
    EXPECT_EQ(string.grid_m.back(), 0.8);
    // At first the plucked triangle, 2 mm high at 0.3 m, but for the modes left out.
    for (std::size_t i = 0; i < string.grid_m.size(); ++i) {
        const double x = string.grid_m[i];
        const double triangle = 0.002 * std::min(x / 0.3, (0.8 - x) / 0.5);
        EXPECT_NEAR(string.snapshots[0].displacement_m[i], triangle, 5e-5) << x;
    }
}

}  // namespace
}  // namespace jawari::host
