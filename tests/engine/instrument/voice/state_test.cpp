// The state of an instrument as hosts see it: reset, clock, controls, what is held and what sounds.
#include "jawari/instrument/state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "jawari/instrument/compile.h"
#include "jawari/instrument/qualities.h"
#include "support/small_instrument.h"

namespace jawari {
namespace {

using test::play;

/// With one quality level below the full one.
const InstrumentModel& small_model() {
    static const InstrumentModel model = [] {
        const InstrumentDescription small = test::small_instrument();
        InstrumentModel compiled = compile_instrument(small, 48000).value();
        const QualityDescription lower{.contact_rate_min_hz = 100000, .mode_limit_hz = 3000};
        EXPECT_FALSE(add_qualities(compiled, small, {&lower, 1}));
        return compiled;
    }();
    return model;
}

void expect_equal(const InstrumentCounters& a, const InstrumentCounters& b) {
    EXPECT_EQ(a.notes, b.notes);
    EXPECT_EQ(a.ignored_notes, b.ignored_notes);
    EXPECT_EQ(a.stolen_notes, b.stolen_notes);
    EXPECT_EQ(a.delayed_notes, b.delayed_notes);
    EXPECT_EQ(a.faded_voices, b.faded_voices);
    EXPECT_EQ(a.legato_notes, b.legato_notes);
}

class ResetOf : public testing::TestWithParam<unsigned> {};

/// Whatever was played before, and however it ended, the next piece has the bits of a new state.
TEST_P(ResetOf, AnInstrumentPlaysTheBitsOfANewState) {
    const InstrumentModel& model = small_model();
    InstrumentState state = make_instrument_state(model);
    if (GetParam() % 2 == 1) set_play_mode(state, PlayMode::Guitar);
    for (std::size_t s = 0; s < model.strings.size(); ++s)
        change_quality(model, state, s, (s + GetParam()) % 2);
    play(model, state, test::storm(GetParam(), 7000, 200), 7013);
    if (GetParam() == 2) {
        state.strings[0].voices[0].string.velocity[2] = std::numeric_limits<double>::quiet_NaN();
        play(model, state, {}, 64);
    }
    EXPECT_GT(sounding_voices(state), 0U);
    EXPECT_GT(state.counters.notes, 0U);

    reset(model, state);
    EXPECT_TRUE(at_rest(state));
    EXPECT_EQ(state.frame, 0U);
    EXPECT_EQ(state.play, model.play);
    EXPECT_EQ(sounding_voices(state), 0U);
    EXPECT_EQ(held_notes(state), 0U);
    EXPECT_EQ(finished_nonfinite_resets(state), 0U);
    EXPECT_EQ(contact_counters(state).steps, 0U);
    expect_equal(state.counters, {});
    for (std::size_t s = 0; s < model.strings.size(); ++s) EXPECT_EQ(quality_level(state, s), 0U);

    InstrumentState fresh = make_instrument_state(model);
    const auto music = test::storm(GetParam() + 10, 12000, 200);
    EXPECT_EQ(play(model, state, music, 12000), play(model, fresh, music, 12000));
    expect_equal(state.counters, fresh.counters);
    EXPECT_EQ(contact_counters(state).steps, contact_counters(fresh).steps);
    EXPECT_EQ(contact_counters(state).impulses, contact_counters(fresh).impulses);
    EXPECT_EQ(state.work.exciters_J, fresh.work.exciters_J);
    EXPECT_EQ(state.work.touches_J, fresh.work.touches_J);
    EXPECT_EQ(state.work.bends_J, fresh.work.bends_J);
    EXPECT_EQ(state.work.transfers_J, fresh.work.transfers_J);
}

INSTANTIATE_TEST_SUITE_P(Storms, ResetOf, testing::Values(1U, 2U, 3U, 4U),
                         [](const auto& storm) { return "storm_" + std::to_string(storm.param); });

/// A bent, muted note sounds the same after another instrument's controls were inherited as after its own
/// events; held notes are not inherited.
TEST(InstrumentControls, AreInheritedWithoutNotes) {
    const InstrumentModel& model = small_model();
    const std::vector<InstrumentEvent> controls{
        bend_channel(0, 1.5), set_parameter(0, ParameterId::PalmMute, 0.4),
        set_parameter(0, ParameterId::Volume, 0.5), set_timbre(0, 0.8), set_soft_pedal(0, 0.3)};
    InstrumentState from = make_instrument_state(model);
    auto with_note = controls;
    with_note.push_back(note_on(0, 45, 0.7));
    play(model, from, with_note, 100);
    InstrumentState to = make_instrument_state(model);
    inherit_controls(from, to);
    EXPECT_EQ(held_notes(to), 0U);

    InstrumentState told = make_instrument_state(model);
    render_instrument(model, told, controls, nullptr, 0);
    const std::vector<InstrumentEvent> note{note_on(0, 43, 0.9)};
    const auto inherited = play(model, to, note, 4000);
    EXPECT_EQ(inherited, play(model, told, note, 4000));
    InstrumentState neutral = make_instrument_state(model);
    EXPECT_NE(inherited, play(model, neutral, note, 4000));
}

/// Vibrato of 5 Hz at 48 kHz has a period of 9600 frames: a clock set on by one period changes no bit, one
/// set on by half a period does.
TEST(InstrumentClock, SetsThePhaseOfTheVibrato) {
    const auto sound_at = [](std::uint64_t frame) {
        const InstrumentModel& model = small_model();
        InstrumentState state = make_instrument_state(model);
        set_clock(state, frame);
        EXPECT_EQ(state.frame, frame);
        return play(model, state,
                    {set_parameter(0, ParameterId::VibratoDepth, 0.5),
                     set_parameter(0, ParameterId::VibratoRate, 5), note_on(0, 45, 0.7)},
                    3000);
    };
    const auto sound = sound_at(0);
    EXPECT_EQ(sound_at(9600), sound);
    EXPECT_NE(sound_at(4800), sound);
}

TEST(InstrumentState, TellsWhatIsHeldAndWhatSounds) {
    const InstrumentModel& model = small_model();  // strings 0 and 1 are one course, string 2 the other
    InstrumentState state = make_instrument_state(model);
    EXPECT_TRUE(at_rest(state));
    play(model, state, {set_sustain_pedal(0, true), note_on(0, 28, 0.5)}, 4096);
    EXPECT_EQ(held_notes(state), 1U);
    EXPECT_TRUE(is_held(model, state, 0));
    EXPECT_TRUE(is_held(model, state, 1));
    EXPECT_FALSE(is_held(model, state, 2));
    EXPECT_EQ(sounding_voices(state, 0), 1U);
    EXPECT_EQ(sounding_voices(state, 1), 1U);
    EXPECT_EQ(sounding_voices(state, 2), 0U);
    EXPECT_EQ(sounding_voices(state), 2U);
    EXPECT_FALSE(at_rest(state));
    play(model, state, {note_off(0, 28)}, 256);
    EXPECT_TRUE(is_held(model, state, 0));  // by the pedal
    play(model, state, {set_sustain_pedal(0, false)}, 256);
    EXPECT_FALSE(is_held(model, state, 0));
    EXPECT_EQ(held_notes(state), 0U);
    EXPECT_EQ(sounding_voices(state), 2U);  // under the damping hand

    state.strings[0].voices[0].string.velocity[1] = std::numeric_limits<double>::quiet_NaN();
    play(model, state, {}, 64);
    EXPECT_EQ(finished_nonfinite_resets(state), 1U);
    EXPECT_EQ(nonfinite_resets(state, 0), 0U);  // the voice ended
    EXPECT_EQ(sounding_voices(state), 1U);
}

#ifndef NDEBUG
TEST(InstrumentStateDeathTest, PreconditionsAreAssertedInDebugBuilds) {
    const InstrumentModel& model = small_model();
    InstrumentState state = make_instrument_state(model);
    EXPECT_DEATH(sounding_voices(state, 3), "strings.size");
    EXPECT_DEATH(string_energy(model, state, 3), "strings.size");
    play(model, state, {note_on(0, 45, 0.5)}, 8);
    EXPECT_DEATH(set_play_mode(state, PlayMode::Guitar), "held_notes");
}
#endif

}  // namespace
}  // namespace jawari
