// Any number of a motion that is no number any more: its string falls silent, nothing else notices, it is
// counted, and the next note is as good as ever.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "jawari/instrument/compile.h"
#include "support/injure.h"
#include "support/small_instrument.h"

namespace jawari {
namespace {

using Type = InstrumentEventType;

constexpr std::size_t injured = 2;  // index of the string; 0 and 1 are another course

const InstrumentModel& model() {
    static const InstrumentModel model = compile_instrument(test::small_instrument(), 48000).value();
    return model;
}

struct Heard {
    std::vector<double> left, right;
    std::array<std::vector<double>, 3> strings;
};

Heard play(InstrumentState& state, const std::vector<InstrumentEvent>& events, std::size_t frames) {
    Heard heard{std::vector<double>(frames), std::vector<double>(frames), {}};
    std::array<double*, 3> stems{};
    for (std::size_t s = 0; s < 3; ++s) {
        heard.strings[s].resize(frames);
        stems[s] = heard.strings[s].data();
    }
    render_instrument(model(), state, events, InstrumentOutput{heard.left.data(), heard.right.data(), stems},
                      frames);
    return heard;
}

/// Both courses sound, bent, under the palm.
InstrumentState in_the_middle() {
    InstrumentState state = make_instrument_state(model());
    play(state,
         {set_parameter(0, ParameterId::PalmMute, 0.3), bend_channel(0, 1), note_on(0, 31, 0.5),
          note_on(0, 45, 0.8)},
         300);
    return state;
}

double peak(const std::vector<double>& samples) {
    double most = 0;
    for (const double sample : samples) most = std::max(most, std::abs(sample));
    return most;
}

void expect_finite(const Heard& heard) {
    for (std::size_t n = 0; n < heard.left.size(); ++n) {
        ASSERT_TRUE(std::isfinite(heard.left[n]) && std::isfinite(heard.right[n])) << "frame " << n;
        for (const auto& string : heard.strings) ASSERT_TRUE(std::isfinite(string[n])) << "frame " << n;
    }
}

class InstrumentNonFinite : public testing::TestWithParam<std::size_t> {};

TEST_P(InstrumentNonFinite, StaysOnItsStringIsCountedAndEndsWithTheNextNote) {
    InstrumentState healthy = in_the_middle();
    const Heard expected = play(healthy, {}, 2000);
    const std::vector<InstrumentEvent> again{note_on(0, 45, 0.8)};
    const double healthy_peak = peak(play(healthy, again, 4000).strings[injured]);
    for (std::size_t bad = 0; bad < 3; ++bad) {
        SCOPED_TRACE("number " + std::to_string(bad));
        InstrumentState state = in_the_middle();
        const std::size_t sounding = state.strings[injured].sounding;
        ASSERT_NE(sounding, no_voice);
        // `where` chooses NaN, inf or -inf by its remainder, then the motion and the touch.
        test::injure(state.strings[injured], GetParam(),
                     bad + 3 * sounding + 9 * static_cast<std::size_t>(TouchSlot::Palm));
        const Heard heard = play(state, {}, 2000);
        expect_finite(heard);
        EXPECT_LE(peak(heard.left), 4 * peak(expected.left) + 1e-3);
        EXPECT_EQ(heard.strings[0], expected.strings[0]);
        EXPECT_EQ(heard.strings[1], expected.strings[1]);
        // Some numbers are brought back into their range, or made anew, before they are used: then the string
        // is not lost.
        const std::uint64_t resets = contact_counters(state).nonfinite_resets + state.body.nonfinite_resets;
        const bool lost = string_energy(model(), state, injured) == 0;
        EXPECT_EQ(resets, lost ? 1U : 0U);
        const Heard next = play(state, again, 4000);
        expect_finite(next);
        EXPECT_GT(peak(next.strings[injured]), 0.5 * healthy_peak);
        EXPECT_LT(peak(next.strings[injured]), 2 * healthy_peak);
        EXPECT_EQ(contact_counters(state).nonfinite_resets + state.body.nonfinite_resets, resets);
    }
}

INSTANTIATE_TEST_SUITE_P(EveryKind, InstrumentNonFinite, testing::Range(std::size_t{0}, test::injury_kinds),
                         [](const auto& kind) { return std::string(test::injury_names[kind.param]); });

TEST(InstrumentNonFinite, EventsWithNoNumbersAreIgnored) {
    InstrumentState expected = in_the_middle();
    InstrumentState state = in_the_middle();
    std::vector<InstrumentEvent> events;
    for (int type = 0; type <= static_cast<int>(Type::SetParameter); ++type) {
        for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300}) {
            for (int key : {-1, 31, 45})
                events.push_back({5, static_cast<Type>(type), 0, key, bad, -1, ParameterId::Pan});
        }
    }
    const Heard heard = play(state, events, 2000);
    const Heard undisturbed = play(expected, {}, 2000);
    EXPECT_EQ(heard.left, undisturbed.left);
    EXPECT_EQ(heard.right, undisturbed.right);
    EXPECT_EQ(contact_counters(state).nonfinite_resets, 0U);
}

}  // namespace
}  // namespace jawari
