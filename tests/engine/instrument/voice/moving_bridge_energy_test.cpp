// The energy of strings, body and a bridge that moves: never more than was given, whatever players do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "jawari/instrument/compile.h"
#include "jawari/instrument/qualities.h"
#include "jawari/instrument/render.h"
#include "jawari/scene/energy.h"
#include "support/moving_bridge.h"

namespace jawari {
namespace {

/// Never more energy than what was given, for heavy bodies and for one that strings throw about.
TEST(MovingBridge, NeverHasMoreEnergyThanItWasGiven) {
    for (const double body_kg : {1.0, 0.05, 0.001}) {
        const auto compiled = compile_instrument(test::played_instrument(body_kg), 48000);
        ASSERT_TRUE(compiled.ok()) << compiled.failure().place;
        const InstrumentModel& model = compiled.value();
        InstrumentState state = make_instrument_state(model);
        std::mt19937_64 random(7);
        double largest = 0, before = 0, largest_debt = 0, worst = 0;
        double left = 0, right = 0;
        for (int n = 0; n < 60000; ++n) {
            std::vector<InstrumentEvent> events;
            if (n % 400 == 0) events = test::random_event(random, model);
            render_instrument(model, state, events, {&left, &right, {}}, 1);
            ASSERT_TRUE(std::isfinite(left + right)) << n;
            const double energy = test::whole_energy(model, state);
            largest = std::max(largest, energy);
            largest_debt = std::max(largest_debt, std::abs(state.bridge.debt_J));
            const double now = energy - test::work_of(state.work);
            worst = std::max(worst, (now - before) / largest);
            before = now;
        }
        EXPECT_GT(contact_counters(state).impulses, 1000U);
        EXPECT_LT(worst, 1e-12) << body_kg;
        EXPECT_LT(largest_debt, 1e-3 * largest) << body_kg;
        EXPECT_EQ(contact_counters(state).nonfinite_resets + finished_nonfinite_resets(state), 0U);
    }
}

TEST(MovingBridge, LegatoKeepsTheBalance) {
    const InstrumentModel model = test::compiled(test::bridged_instrument());
    for (const double slide_s : {0.0, 0.02}) {
        InstrumentState state = make_instrument_state(model);
        test::Balance balance(model, state);
        const auto key = [&](std::size_t fret) { return model.strings[2].stopped[fret].key; };
        test::play_balanced(
            model, state, balance,
            {set_parameter(0, ParameterId::Legato, 1, 0),
             set_parameter(0, ParameterId::SlideTime, slide_s, 0), note_on(0, key(2), 0.6, 0)},
            2000);
        test::play_balanced(model, state, balance, {note_on(0, key(5), 0.6, 0)}, 3000);  // hammer-on or slide
        test::play_balanced(model, state, balance, {note_off(0, key(5), 0.5, 0)}, 3000);  // pull-off or back
        EXPECT_EQ(state.counters.legato_notes, 2U);
        EXPECT_GT(string_energy(model, state, 2), 0);
        EXPECT_LT(balance.worst(), 1e-12) << slide_s;
    }
}

TEST(MovingBridge, AChangeOfQualityKeepsTheBalance) {
    const InstrumentDescription instrument = test::bridged_instrument();
    InstrumentModel model = test::compiled(instrument);
    const QualityDescription lower{.contact_rate_min_hz = 96000, .mode_limit_hz = 4000};
    ASSERT_FALSE(add_qualities(model, instrument, {&lower, 1}));
    InstrumentState state = make_instrument_state(model);
    test::Balance balance(model, state);
    const int key = model.strings[2].stopped[0].key;
    test::play_balanced(model, state, balance, {note_on(0, key, 0.7, 0)}, 2005);
    for (const std::size_t level : {1U, 0U, 1U}) {
        const double before = string_energy(model, state, 2);
        for (std::size_t s = 0; s < model.strings.size(); ++s) change_quality(model, state, s, level);
        EXPECT_NEAR(string_energy(model, state, 2) / before, 1, 0.1);
        test::play_balanced(model, state, balance, {}, 1003);
    }
    EXPECT_NE(state.work.quality_changes_J, 0);
    EXPECT_LT(balance.worst(), 1e-12);
}

/// As many strings as an instrument can have, on a light body of few modes.
TEST(MovingBridge, CarriesAllStringsThatAnInstrumentCanHave) {
    InstrumentDescription instrument;
    instrument.quality = {.contact_rate_min_hz = 96000, .mode_limit_hz = 3000};
    instrument.exciters.push_back(
        {.name = "finger", .place = {.share = 0.2}, .body = FingerDescription{.full_height_m = 0.001}});
    for (std::size_t s = 0; s < limits::instrument_strings; ++s) {
        InstrumentStringDescription string;
        string.open_note = static_cast<int>(s);
        string.open_frequency_hz = 100 + 7.3 * static_cast<double>(s);
        string.length_m = 0.6;
        string.linear_density_kg_per_m = 1e-3;
        string.damping = DecayTimePoints{{{{100, 4}, {3000, 1}}}};
        instrument.strings.push_back(string);
    }
    for (std::size_t j = 0; j < 6; ++j) {
        BodyModeDescription mode;
        mode.frequency_hz = 90 + 170 * static_cast<double>(j);
        mode.t60_s = 0.3;
        mode.gain_left = mode.gain_right = 1;
        mode.mass_kg = 0.05;
        for (std::size_t s = 0; s < limits::instrument_strings; ++s)
            mode.shape.push_back(std::cos(static_cast<double>(s * (j + 1)) / 40));
        instrument.body.push_back(mode);
    }
    instrument.bridge = BridgeDescription{};
    const InstrumentModel model = test::compiled(instrument);
    InstrumentState state = make_instrument_state(model);
    test::Balance balance(model, state);
    std::vector<InstrumentEvent> all;
    for (int key = 0; key < static_cast<int>(limits::instrument_strings); ++key)
        all.push_back(note_on(0, key, 0.3 + 0.005 * key, 0));
    test::play_balanced(model, state, balance, all, 1500);
    EXPECT_EQ(sounding_voices(state), limits::instrument_strings);
    EXPECT_EQ(test::voices_in_runs(state), limits::instrument_strings);
    EXPECT_LT(balance.worst(), 1e-12);
}

}  // namespace
}  // namespace jawari
