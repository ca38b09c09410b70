// Voices that fly through runs of frames on a moving bridge, beside frames one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "instrument/voice/voice.h"
#include "jawari/instrument/render.h"
#include "support/moving_bridge.h"

namespace jawari {
namespace {

/// Every frame is computed by itself from now on.
void forbid_runs(InstrumentState& state) {
    for (InstrumentStringState& string : state.strings) {
        for (Voice& voice : string.voices) voice.run.not_before = unknown_frame;
    }
}

struct RunsAndFrames {
    std::vector<double> with_runs, without;
    std::uint64_t impulses_with = 0, impulses_without = 0;
    std::size_t in_runs = 0;
};

/// The same notes with runs and without, in blocks that end within runs.
RunsAndFrames play_both(const InstrumentModel& model, double velocity, std::size_t frames) {
    RunsAndFrames both;
    constexpr std::size_t block = 20;
    for (const bool with : {true, false}) {
        InstrumentState state = make_instrument_state(model);
        std::vector<double>& out = with ? both.with_runs : both.without;
        out.resize(frames);
        for (std::size_t n = 0; n + block <= frames; n += block) {
            std::vector<InstrumentEvent> events;
            if (n == 0) {
                for (const auto& course : model.courses)
                    events.push_back(
                        note_on(0, model.strings[course.strings[0]].stopped[2].key, velocity, 0));
            }
            if (n == 400) events.push_back(bend_channel(7, 0.5, 0));
            render_instrument(model, state, events, out.data() + n, block);
            if (!with) forbid_runs(state);
            if (with) both.in_runs += test::voices_in_runs(state);
        }
        (with ? both.impulses_with : both.impulses_without) = contact_counters(state).impulses;
    }
    return both;
}

double largest_of(const std::vector<double>& signal) {
    double largest = 0;
    for (const double sample : signal) largest = std::max(largest, std::abs(sample));
    return largest;
}

TEST(EndRun, GivesWhatFramesGiveOneByOne) {
    const InstrumentModel model = test::compiled(test::bridged_instrument());
    ASSERT_EQ(model.body.count, 1U);
    const RunsAndFrames both = play_both(model, 0.05, 12000);
    EXPECT_GT(both.in_runs, 200U);
    const double largest = largest_of(both.without);
    ASSERT_GT(largest, 0);
    for (std::size_t n = 0; n < both.without.size(); ++n)
        ASSERT_NEAR(both.with_runs[n], both.without[n], 1e-9 * largest) << n;
}

/// Loud notes strike the frets. Until the rounding of two ways to compute has grown they are the same.
TEST(EndRun, MissesNoImpact) {
    const InstrumentModel model = test::compiled(test::bridged_instrument());
    const RunsAndFrames both = play_both(model, 1, 2400);
    EXPECT_GT(both.in_runs, 20U);
    EXPECT_GT(both.impulses_without, 100U);
    EXPECT_EQ(both.impulses_with, both.impulses_without);
    const double largest = largest_of(both.without);
    for (std::size_t n = 0; n < both.without.size(); ++n)
        ASSERT_NEAR(both.with_runs[n], both.without[n], 1e-6 * largest) << n;
}

}  // namespace
}  // namespace jawari
