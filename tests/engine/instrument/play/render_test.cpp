// Playing: block sizes, sample accuracy, clicks, rest, and which string and voice a note takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "jawari/instrument/compile.h"
#include "jawari/instrument/render.h"
#include "jawari/scene/render.h"
#include "string/state/excitation.h"
#include "support/bass_instrument.h"
#include "support/scenes.h"

namespace jawari {
namespace {

using test::bass_instrument;

constexpr double rate_hz = 48000;

const InstrumentModel& bass_model() {
    static const InstrumentModel model = compile_instrument(bass_instrument(), rate_hz).value();
    return model;
}

/// A whole performance in blocks of the given size.
std::vector<double> play(InstrumentState& state, const std::vector<InstrumentEvent>& events,
                         std::size_t frames, std::size_t block = 512) {
    std::vector<double> output(frames);
    std::size_t next = 0;
    for (std::size_t begin = 0; begin < frames; begin += block) {
        const std::size_t count = std::min(block, frames - begin);
        std::vector<InstrumentEvent> here;
        for (; next < events.size() && events[next].frame < begin + count; ++next) {
            here.push_back(events[next]);
            here.back().frame -= begin;
        }
        render_instrument(bass_model(), state, here, output.data() + begin, count);
    }
    return output;
}

std::vector<double> play(const std::vector<InstrumentEvent>& events, std::size_t frames,
                         std::size_t block = 512) {
    InstrumentState state = make_instrument_state(bass_model());
    return play(state, events, frames, block);
}

double largest(const std::vector<double>& x) {
    double most = 0;
    for (const double value : x) most = std::max(most, std::abs(value));
    return most;
}

/// Largest |x[n+1] - 2 x[n] + x[n-1]| for n in [begin, end).
double sharpest(const std::vector<double>& x, std::size_t begin, std::size_t end) {
    double most = 0;
    for (std::size_t n = begin; n < end; ++n) most = std::max(most, std::abs(x[n + 1] - 2 * x[n] + x[n - 1]));
    return most;
}

/// Hard plucks that hit the frets, note changes, the pedal, thefts, and repeats too fast for the voices.
std::vector<InstrumentEvent> busy_events() {
    std::vector<InstrumentEvent> events{note_on(3, 28, 1),
                                        note_on(700, 40, 0.9),
                                        note_off(1500, 28, 0),
                                        set_sustain_pedal(1600, true),
                                        note_on(1601, 45, 1),
                                        note_off(2000, 45, 0),
                                        note_on(2500, 31, 0.8),
                                        note_on(2500, 34, 0.8),
                                        note_on(2600, 43, 0.7),
                                        note_on(2999, 62, 1),
                                        set_sustain_pedal(3600, false)};
    for (std::size_t i = 0; i < 12; ++i)
        events.push_back(note_on(4000 + 23 * i, 28 + static_cast<int>(i % 3), 1));
    events.push_back(all_notes_off(5000));
    events.push_back(all_sound_off(5500));
    return events;
}

TEST(InstrumentRender, BlockSizeDoesNotChangeABit) {
    const auto whole = play(busy_events(), 6000, 6000);
    EXPECT_GT(largest(whole), 0.1);
    for (const std::size_t block : {1U, 17U, 64U, 1024U}) {
        EXPECT_EQ(play(busy_events(), 6000, block), whole) << "blocks of " << block;
    }
}

TEST(InstrumentRender, EventsAtTheEndOfABlockBelongToTheNext) {
    InstrumentState state = make_instrument_state(bass_model());
    std::vector<double> early(64), late(64);
    const InstrumentEvent event = note_on(64, 28, 1);
    render_instrument(bass_model(), state, {&event, 1}, early.data(), 64);
    render_instrument(bass_model(), state, {}, late.data(), 64);
    EXPECT_EQ(largest(early), 0);
    EXPECT_EQ(late, play({note_on(0, 28, 1)}, 64));
}

TEST(InstrumentRender, TheFirstSampleANoteChangesIsThatOfItsEvent) {
    for (const std::size_t frame : {0U, 1U, 511U, 777U}) {
        const auto output = play({note_on(frame, 33, 0.2)}, 1200);
        const auto first = std::find_if(output.begin(), output.end(), [](double x) { return x != 0; });
        EXPECT_EQ(static_cast<std::size_t>(first - output.begin()), frame);
    }
    const auto held = play({note_on(0, 33, 0.2)}, 6000);
    const auto released = play({note_on(0, 33, 0.2), note_off(5000, 33, 0)}, 6000);
    const auto differs = std::mismatch(held.begin(), held.end(), released.begin());
    EXPECT_EQ(differs.first - held.begin(), 5000);
}

/// A motion's state is sized for the open string; a state of the stopped string's own size gives the same
/// numbers. The finger's force is that of half-cosine flanks averaged over each frame.
TEST(InstrumentRender, AMotionIsTheCompiledStringUnderTheFingersForce) {
    const InstrumentModel& model = bass_model();
    const std::size_t fret = 9;
    const StoppedStringModel& stopped = model.strings[3].stopped[fret];
    const auto output = play({note_on(0, 43 + static_cast<int>(fret), 1)}, 1000);
    StringState state = make_string_state(stopped.string);
    const double L = stopped.string.shape->length_m;
    const double rise = std::ceil(0.004 * rate_hz), release = std::ceil(0.0005 * rate_hz);
    for (std::size_t n = 0; n < 1000; ++n) {
        double force = 0;  // the mean of 1000 samples within the frame
        for (int i = 0; i < 1000; ++i) {
            const double t = static_cast<double>(n) + (i + 0.5) / 1000;
            const double x = t < rise ? t / rise : std::max(0.0, (rise + release - t) / release);
            force += 0.5 * (1 - std::cos(3.14159265358979323846 * x)) / 1000;
        }
        clear_excitation(state);
        if (n < static_cast<std::size_t>(rise + release))
            test::press(stopped.string, state, L - 0.16, stopped.full_force_N[0] * force);
        advance_frame(stopped.string, state);
        double expected = 0;
        for (std::size_t k = 0; k < stopped.string.shape->mode_count; ++k)
            expected += 0.3 * stopped.pickup_rows[k] * state.velocity[k];
        ASSERT_NEAR(output[n], expected, 1e-6) << "frame " << n;
    }
    EXPECT_GT(state.counters.impulses, 0U);
}

TEST(InstrumentRender, SoftNotesClearTheFretsAndHardOnesStrikeThem) {
    const auto impulses = [](int key, double velocity) {
        InstrumentState state = make_instrument_state(bass_model());
        play(state, {note_on(0, key, velocity)}, 4800);
        return contact_counters(state).impulses;
    };
    for (const int key : {28, 30, 33, 36, 38, 43, 50}) {
        EXPECT_EQ(impulses(key, 30 / 127.0), 0U) << key;
        EXPECT_GT(impulses(key, 1), 0U) << key;
    }
}

// ---------------------------------------------------------------------------------------------- clicks

TEST(InstrumentRender, NoteOffDoesNotClick) {
    constexpr std::size_t off = 9600;
    const auto output = play({note_on(0, 33, 0.2), note_off(off, 33, 0)}, 14400);
    const double around =
        std::max(sharpest(output, off - 2400, off - 240), sharpest(output, off + 240, off + 2400));
    EXPECT_LE(sharpest(output, off - 240, off + 240), 2 * around);
    EXPECT_LT(sharpest(output, 14000, 14390), 0.1 * around);  // it has gone: T60 is about 0.1 s
}

TEST(InstrumentRender, ChangingTheNoteOnAStringDoesNotClick) {
    constexpr std::size_t change = 9600;
    const auto changed = play({note_on(0, 28, 0.2), note_on(change, 30, 0.2)}, 12000);
    const auto first = play({note_on(0, 28, 0.2)}, 12000);
    const auto second = play({note_on(change, 30, 0.2)}, 12000);
    const double apart =
        std::max(sharpest(first, change - 240, change + 480), sharpest(second, change - 1, change + 480));
    EXPECT_LE(sharpest(changed, change - 240, change + 480), 2 * apart);
}

TEST(InstrumentRender, AStringDoesOneThingAtATime) {
    InstrumentState state = make_instrument_state(bass_model());
    const auto busy = [&] {
        std::size_t count = 0;
        for (const InstrumentStringState& string : state.strings) count += string.busy;
        return count;
    };
    play(state, {note_on(0, 28, 0.2), note_on(4800, 30, 0.2)}, 4801);
    EXPECT_EQ(busy(), 2U);  // the first fades
    play(state, {}, 240);
    EXPECT_EQ(busy(), 1U);
    EXPECT_EQ(state.counters.faded_voices, 1U);
}

TEST(InstrumentRender, TakingVoicesAwayDoesNotClick) {
    // Five notes in 40 ms on one string.
    std::vector<InstrumentEvent> events;
    for (std::size_t i = 0; i < 5; ++i) events.push_back(note_on(480 * i, 28 + static_cast<int>(i), 0.2));
    const double apart = sharpest(play({events.begin(), events.begin() + 2}, 9600), 1, 9500);
    InstrumentState state = make_instrument_state(bass_model());
    const auto output = play(state, events, 9600);
    EXPECT_GT(state.counters.faded_voices, 0U);
    EXPECT_LE(sharpest(output, 1, 9500), 2 * apart);
}

TEST(InstrumentRender, ANoteThatFindsNoVoiceWaitsForOne) {
    std::vector<InstrumentEvent> events;
    for (std::size_t i = 0; i < 4; ++i) events.push_back(note_on(10 * i, 28 + static_cast<int>(i), 0.2));
    InstrumentState state = make_instrument_state(bass_model());
    play(state, events, 600);
    EXPECT_EQ(state.counters.delayed_notes, 1U);
    EXPECT_EQ(state.counters.notes, 4U);
    EXPECT_EQ(state.counters.ignored_notes, 0U);
    EXPECT_EQ(state.strings[0].voices[state.strings[0].sounding].fret, 3U);  // the last one sounds
}

// ---------------------------------------------------------------------------------------------- rest

TEST(InstrumentRender, ReleasedNotesComeToRest) {
    InstrumentState state = make_instrument_state(bass_model());
    EXPECT_TRUE(at_rest(state));
    play(state, {note_on(0, 28, 1), note_off(1000, 28, 0)}, 2000);
    EXPECT_FALSE(at_rest(state));
    play(state, {}, 48000);  // 150 dB in energy
    EXPECT_TRUE(at_rest(state));
    const auto counted = contact_counters(state);
    EXPECT_GT(counted.impulses, 0U);
    EXPECT_EQ(counted.nonfinite_resets, 0U);
    EXPECT_EQ(largest(play(state, {}, 100)), 0);
    EXPECT_EQ(contact_counters(state).steps, counted.steps);  // rest costs nothing
}

TEST(InstrumentRender, AllSoundOffEndsWithinTheFade) {
    InstrumentState state = make_instrument_state(bass_model());
    play(state, {note_on(0, 28, 1), note_on(10, 50, 1), all_sound_off(2000)}, 2000 + 145);
    EXPECT_TRUE(at_rest(state));
}

// ---------------------------------------------------------------------------------------------- strings

std::vector<int> held_keys(const InstrumentState& state) {
    std::vector<int> keys;
    for (const CourseState& course : state.courses) keys.push_back(course.held.active ? course.held.key : -1);
    return keys;
}

std::vector<int> held_after(const std::vector<InstrumentEvent>& events) {
    InstrumentState state = make_instrument_state(bass_model());
    play(state, events, 64);
    return held_keys(state);
}

TEST(InstrumentNotes, AFreeStringWithTheLowestFretIsTaken) {
    EXPECT_EQ(held_after({note_on(0, 28, 0.2)}), (std::vector{28, -1, -1, -1}));
    EXPECT_EQ(held_after({note_on(0, 33, 0.2)}), (std::vector{-1, 33, -1, -1}));
    EXPECT_EQ(held_after({note_on(0, 48, 0.2)}), (std::vector{-1, -1, -1, 48}));
    EXPECT_EQ(held_after({note_on(0, 48, 0.2), note_on(0, 47, 0.2)}), (std::vector{-1, -1, 47, 48}));
}

TEST(InstrumentNotes, AHeldKeyIsPluckedAgainOnItsString) {
    EXPECT_EQ(held_after({note_on(0, 44, 0.2), note_on(1, 45, 0.2), note_on(2, 45, 0.2)}),
              (std::vector{-1, -1, 45, 44}));
}

TEST(InstrumentNotes, PedalledNotesAreTakenBeforeHeldOnesThenTheOldest) {
    // 33 can be on the E and the A string. Both are held; the A string's key is up, the pedal down.
    EXPECT_EQ(held_after({set_sustain_pedal(0, true), note_on(0, 28, 0.2), note_on(0, 34, 0.2),
                          note_off(1, 34, 0), note_on(2, 33, 0.2)}),
              (std::vector{28, 33, -1, -1}));
    EXPECT_EQ(held_after({note_on(0, 34, 0.2), note_on(0, 28, 0.2), note_on(2, 33, 0.2)}),
              (std::vector{28, 33, -1, -1}));
    EXPECT_EQ(held_after({note_on(0, 28, 0.2), note_on(0, 34, 0.2), note_on(2, 33, 0.2)}),
              (std::vector{33, 34, -1, -1}));
}

TEST(InstrumentNotes, ThePedalHoldsAndLetsGo) {
    std::vector<InstrumentEvent> events{set_sustain_pedal(0, true), note_on(0, 28, 0.2), note_off(1, 28, 0)};
    EXPECT_EQ(held_after(events), (std::vector{28, -1, -1, -1}));
    events.push_back(set_sustain_pedal(2, false, 1));  // another channel's pedal
    EXPECT_EQ(held_after(events), (std::vector{28, -1, -1, -1}));
    events.push_back(set_sustain_pedal(3, false));
    EXPECT_EQ(held_after(events), (std::vector{-1, -1, -1, -1}));
}

TEST(InstrumentNotes, ChannelsAreApart) {
    EXPECT_EQ(held_after({note_on(0, 28, 0.2, 3), note_off(1, 28, 0, 4)}), (std::vector{28, -1, -1, -1}));
    EXPECT_EQ(held_after({note_on(0, 28, 0.2, 3), all_notes_off(1, 4)}), (std::vector{28, -1, -1, -1}));
    EXPECT_EQ(held_after({note_on(0, 28, 0.2, 3), all_notes_off(1, 3)}), (std::vector{-1, -1, -1, -1}));
}

TEST(InstrumentNotes, NotesOutOfRangeAreCountedAndNonsenseIsIgnored) {
    InstrumentState state = make_instrument_state(bass_model());
    const auto output =
        play(state,
             {note_on(0, 27, 1), note_on(0, 64, 1), note_on(0, 28, std::nan("")), note_on(0, 28, 2),
              note_on(0, 28, 1, 16), note_on(0, -1, 1), note_off(0, 128, 0), note_on(0, 28, 0)},
             256);
    EXPECT_EQ(largest(output), 0);
    EXPECT_EQ(state.counters.ignored_notes, 2U);
    EXPECT_EQ(state.counters.notes, 0U);
}

}  // namespace
}  // namespace jawari
