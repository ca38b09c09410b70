// Voices that fly through runs of frames on a moving bridge, beside frames one by one; legato, changes of
// quality and many strings there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "instrument/voice/voice.h"
#include "jawari/instrument/compile.h"
#include "jawari/instrument/qualities.h"
#include "jawari/instrument/render.h"
#include "support/small_instrument.h"

namespace jawari {
namespace {

constexpr double run_rate_hz = 48000;

/// Frets, a thread, cotton, pickups, and a body of which the last mode listens.
InstrumentDescription bridged_instrument() {
    InstrumentDescription instrument = test::small_instrument();
    for (std::size_t j = 0; j < instrument.body.size(); ++j) {
        instrument.body[j].mass_kg = 0.2;
        instrument.body[j].shape = {1, j == 0 ? 0.9 : -0.7, 0.8};
    }
    BodyModeDescription listens = instrument.body.back();
    listens.mass_kg = 0;
    listens.shape.clear();
    instrument.body.push_back(listens);
    instrument.soft_touches.clear();
    instrument.bridge = BridgeDescription{};
    return instrument;
}

InstrumentModel model_of(const InstrumentDescription& instrument) {
    auto compiled = compile_instrument(instrument, run_rate_hz);
    EXPECT_TRUE(compiled.ok());
    return std::move(compiled.value());
}

/// Every frame is computed by itself from now on.
void forbid_runs(InstrumentState& state) {
    for (InstrumentStringState& string : state.strings) {
        for (Voice& voice : string.voices) voice.run.not_before = unknown_frame;
    }
}

std::size_t voices_in_runs(const InstrumentState& state) {
    std::size_t count = 0;
    for (const InstrumentStringState& string : state.strings) {
        for (const Voice& voice : string.voices) count += voice.run.frames > 0 ? 1 : 0;
    }
    return count;
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
            if (with) both.in_runs += voices_in_runs(state);
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
    const InstrumentModel model = model_of(bridged_instrument());
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
    const InstrumentModel model = model_of(bridged_instrument());
    const RunsAndFrames both = play_both(model, 1, 2400);
    EXPECT_GT(both.in_runs, 20U);
    EXPECT_GT(both.impulses_without, 100U);
    EXPECT_EQ(both.impulses_with, both.impulses_without);
    const double largest = largest_of(both.without);
    for (std::size_t n = 0; n < both.without.size(); ++n)
        ASSERT_NEAR(both.with_runs[n], both.without[n], 1e-6 * largest) << n;
}

double energy_of_all(const InstrumentModel& model, InstrumentState& state) {
    double sum = bridge_energy(model, state);
    for (std::size_t s = 0; s < model.strings.size(); ++s) sum += string_energy(model, state, s);
    return sum;
}

double work_of_all(const PlayerWork& work) {
    return work.exciters_J + work.touches_J + work.bends_J + work.transfers_J + work.quality_changes_J +
           work.noises_J + work.couplings_J;
}

/// The energy of all, less what was given, must not rise from frame to frame. Where a voice takes over from
/// another, which still fades, both count: transfers_J is the new one's energy less the old one's.
class Balance {
  public:
    Balance(const InstrumentModel& model, InstrumentState& state) : model_(model), state_(state) {}

    void look() {
        const double energy = energy_of_all(model_, state_);
        const double now = energy - work_of_all(state_.work);
        largest_ = std::max(largest_, energy);
        if (state_.counters.legato_notes == transfers_) worst_ = std::max(worst_, now - before_);
        transfers_ = state_.counters.legato_notes;
        before_ = now;
    }
    [[nodiscard]] double worst() const { return worst_ / largest_; }

  private:
    const InstrumentModel& model_;
    InstrumentState& state_;
    std::uint64_t transfers_ = 0;
    double before_ = 0, largest_ = 0, worst_ = 0;
};

void play_balanced(const InstrumentModel& model, InstrumentState& state, Balance& balance,
                   const std::vector<InstrumentEvent>& events, std::size_t frames) {
    double left = 0, right = 0;
    for (std::size_t n = 0; n < frames; ++n) {
        render_instrument(model, state, n == 0 ? events : std::vector<InstrumentEvent>(), {&left, &right, {}},
                          1);
        ASSERT_TRUE(std::isfinite(left + right));
        balance.look();
    }
}

TEST(MovingBridge, LegatoKeepsTheBalance) {
    const InstrumentModel model = model_of(bridged_instrument());
    for (const double slide_s : {0.0, 0.02}) {
        InstrumentState state = make_instrument_state(model);
        Balance balance(model, state);
        const auto key = [&](std::size_t fret) { return model.strings[2].stopped[fret].key; };
        play_balanced(model, state, balance,
                      {set_parameter(0, ParameterId::Legato, 1, 0),
                       set_parameter(0, ParameterId::SlideTime, slide_s, 0), note_on(0, key(2), 0.6, 0)},
                      2000);
        play_balanced(model, state, balance, {note_on(0, key(5), 0.6, 0)}, 3000);   // hammer-on or slide
        play_balanced(model, state, balance, {note_off(0, key(5), 0.5, 0)}, 3000);  // pull-off or back
        EXPECT_EQ(state.counters.legato_notes, 2U);
        EXPECT_GT(string_energy(model, state, 2), 0);
        EXPECT_LT(balance.worst(), 1e-12) << slide_s;
    }
}

TEST(MovingBridge, AChangeOfQualityKeepsTheBalance) {
    const InstrumentDescription instrument = bridged_instrument();
    InstrumentModel model = model_of(instrument);
    const QualityDescription lower{.contact_rate_min_hz = 96000, .mode_limit_hz = 4000};
    ASSERT_FALSE(add_qualities(model, instrument, {&lower, 1}));
    InstrumentState state = make_instrument_state(model);
    Balance balance(model, state);
    const int key = model.strings[2].stopped[0].key;
    play_balanced(model, state, balance, {note_on(0, key, 0.7, 0)}, 2005);
    for (const std::size_t level : {1U, 0U, 1U}) {
        const double before = string_energy(model, state, 2);
        for (std::size_t s = 0; s < model.strings.size(); ++s) change_quality(model, state, s, level);
        EXPECT_NEAR(string_energy(model, state, 2) / before, 1, 0.1);
        play_balanced(model, state, balance, {}, 1003);
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
    const InstrumentModel model = model_of(instrument);
    InstrumentState state = make_instrument_state(model);
    Balance balance(model, state);
    std::vector<InstrumentEvent> all;
    for (int key = 0; key < static_cast<int>(limits::instrument_strings); ++key)
        all.push_back(note_on(0, key, 0.3 + 0.005 * key, 0));
    play_balanced(model, state, balance, all, 1500);
    EXPECT_EQ(sounding_voices(state), limits::instrument_strings);
    EXPECT_EQ(voices_in_runs(state), limits::instrument_strings);
    EXPECT_LT(balance.worst(), 1e-12);
}

}  // namespace
}  // namespace jawari
