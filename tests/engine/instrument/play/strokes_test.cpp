// A string does one thing at a time: what happens to its earlier voices when a note begins.
#include <gtest/gtest.h>

#include "jawari/instrument/compile.h"
#include "support/small_instrument.h"

namespace jawari {
namespace {

using test::play;

/// One string with three voices, without a body, so that it comes to rest.
const InstrumentModel& one_string() {
    static const InstrumentModel model = [] {
        InstrumentDescription bass = test::bass_instrument();
        bass.strings = {bass.strings[1]};  // A, key 33
        bass.frets.count = 7;
        bass.frets.height_m.clear();
        bass.quality.mode_limit_hz = 6000;
        return compile_instrument(bass, 48000).value();
    }();
    return model;
}

std::size_t not_fading(const InstrumentState& state) {
    std::size_t count = 0;
    for (const Voice& voice : state.strings[0].voices)
        count += voice.phase != VoicePhase::Idle && !voice.fading ? 1 : 0;
    return count;
}

/// Released, and an idle voice is left: the next note at another fret fades the earlier voice all the same,
/// and fade_s later it alone sounds.
TEST(OneThingAtATime, AReleasedVoiceFadesWhenAnotherNoteBeginsThoughAVoiceIsIdle) {
    const InstrumentModel& model = one_string();
    InstrumentState state = make_instrument_state(model);
    ASSERT_EQ(state.strings[0].voices.size(), voices_per_string);
    play(model, state, {note_on(0, 33, 0.8), note_off(2000, 33)}, 2100);
    ASSERT_EQ(sounding_voices(state), 1U);
    EXPECT_EQ(not_fading(state), 1U);

    play(model, state, {note_on(0, 36, 0.8)}, 1);
    EXPECT_EQ(sounding_voices(state), 2U);  // so one of the three is idle
    EXPECT_EQ(not_fading(state), 1U);
    EXPECT_EQ(state.counters.faded_voices, 1U);
    EXPECT_EQ(state.counters.delayed_notes, 0U);
    const auto fade_frames = static_cast<std::size_t>(fade_s * 48000);
    play(model, state, {}, fade_frames);
    EXPECT_EQ(sounding_voices(state), 1U);
    EXPECT_EQ(state.strings[0].voices[state.strings[0].sounding].fret, 3U);
}

/// Also a note that is still held: the string leaves its fret.
TEST(OneThingAtATime, AHeldNoteFadesWhenItsStringPlaysAnotherFret) {
    const InstrumentModel& model = one_string();
    InstrumentState state = make_instrument_state(model);
    play(model, state, {note_on(0, 33, 0.8), note_on(1000, 36, 0.8), note_on(2000, 38, 0.8)}, 2001);
    EXPECT_EQ(state.counters.faded_voices, 2U);
    EXPECT_EQ(not_fading(state), 1U);
}

/// Three notes within fade_s: the third finds no idle voice and waits; a fourth takes its place.
TEST(OneThingAtATime, ANoteWaitsForAVoiceAndAFurtherOneReplacesIt) {
    const InstrumentModel& model = one_string();
    InstrumentState state = make_instrument_state(model);
    play(model, state,
         {note_on(0, 33, 0.8), note_on(20, 35, 0.8), note_on(40, 36, 0.8), note_on(60, 38, 0.8)}, 61);
    EXPECT_EQ(state.counters.delayed_notes, 1U);  // the fourth
    EXPECT_EQ(state.counters.ignored_notes, 0U);
    play(model, state, {note_on(0, 40, 0.8)}, 1);
    EXPECT_EQ(state.counters.delayed_notes, 2U);
    EXPECT_EQ(state.counters.ignored_notes, 1U);
    play(model, state, {}, 300);
    EXPECT_EQ(not_fading(state), 1U);
    EXPECT_EQ(state.strings[0].voices[state.strings[0].sounding].fret, 7U);
}

/// The same fret again excites the voice that sounds there.
TEST(OneThingAtATime, TheSameFretIsExcitedAgain) {
    const InstrumentModel& model = one_string();
    InstrumentState state = make_instrument_state(model);
    play(model, state, {note_on(0, 33, 0.8), note_off(1000, 33), note_on(1500, 33, 0.8)}, 2000);
    EXPECT_EQ(sounding_voices(state), 1U);
    EXPECT_EQ(state.counters.notes, 2U);
    EXPECT_EQ(state.counters.faded_voices, 0U);
}

}  // namespace
}  // namespace jawari
