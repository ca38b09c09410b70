// As many notes of a chord sound as any choice of strings allows: against all choices.
#include "instrument/play/chord_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "jawari/instrument/compile.h"
#include "jawari/instrument/events.h"
#include "support/bass_instrument.h"

namespace jawari {
namespace {

const InstrumentModel& four_strings() {
    static const InstrumentModel model = compile_instrument(test::bass_instrument(), 48000).value();
    return model;
}

InstrumentState played(const std::vector<InstrumentEvent>& events) {
    InstrumentState state = make_instrument_state(four_strings());
    std::vector<double> output(64);
    render_instrument(four_strings(), state, events, output.data(), output.size());
    return state;
}

std::vector<int> sounding_keys(const InstrumentState& state) {
    std::vector<int> keys;
    for (const CourseState& course : state.courses) {
        if (course.held.active) keys.push_back(course.held.key);
    }
    std::sort(keys.begin(), keys.end());
    return keys;
}

/// Notes that can sound together: the best of all choices of a string, or of none, for each.
std::size_t most_notes(const std::vector<int>& keys, std::size_t note, std::vector<bool>& taken) {
    if (note == keys.size()) return 0;
    std::size_t most = most_notes(keys, note + 1, taken);
    for (std::size_t c = 0; c < taken.size(); ++c) {
        if (taken[c] || fret_of(four_strings(), c, keys[note]) == no_fret) continue;
        taken[c] = true;
        most = std::max(most, 1 + most_notes(keys, note + 1, taken));
        taken[c] = false;
    }
    return most;
}

TEST(Chord, ALowNoteMovesOverForAHighOne) {
    // 50 has its lowest fret on the G string, the only one that has 62.
    ASSERT_NE(fret_of(four_strings(), 3, 62), no_fret);
    ASSERT_EQ(fret_of(four_strings(), 2, 62), no_fret);
    const InstrumentState state = played({note_on(0, 50, 0.2), note_on(0, 62, 0.2)});
    EXPECT_EQ(state.courses[2].held.key, 50);
    EXPECT_EQ(state.courses[3].held.key, 62);
    EXPECT_EQ(state.counters.stolen_notes, 0U);
}

TEST(Chord, NotesOfOtherFramesStayWhereTheyAre) {
    const InstrumentState state = played({note_on(0, 50, 0.2), note_on(1, 62, 0.2)});
    EXPECT_EQ(sounding_keys(state), (std::vector{62}));
    EXPECT_EQ(state.counters.stolen_notes, 1U);
}

TEST(Chord, HeldNotesAreNotTakenWhereTheChordCanMove) {
    // The E string is held; of the chord, 45 would take D and 40 A, which 34 then needs.
    const InstrumentState state =
        played({note_on(0, 28, 0.2), note_on(1, 40, 0.2), note_on(1, 45, 0.2), note_on(1, 34, 0.2)});
    EXPECT_EQ(sounding_keys(state), (std::vector{28, 34, 40, 45}));
    EXPECT_EQ(state.counters.stolen_notes, 0U);
}

TEST(Chord, BendsAndPressuresBetweenItsNotesDoNotPartIt) {
    // As MPE senders have it: each note on a channel of its own, with its bend and pressure.
    const InstrumentState state =
        played({bend_channel(0, 0.5, 1), note_on(0, 50, 0.2, 1), press_channel(0, 0.3, 1),
                bend_channel(0, -0.5, 2), set_timbre(0, 0.4, 2), note_on(0, 62, 0.2, 2)});
    EXPECT_EQ(sounding_keys(state), (std::vector{50, 62}));
    EXPECT_EQ(state.counters.stolen_notes, 0U);
}

TEST(Chord, AReleasePartsIt) {
    const InstrumentState state = played({note_on(0, 50, 0.2), note_off(0, 40, 0.5), note_on(0, 62, 0.2)});
    EXPECT_EQ(sounding_keys(state), (std::vector{62}));
}

TEST(Chord, AKeyThatIsThereTwiceIsOneNote) {
    const InstrumentState state = played({note_on(0, 50, 0.2), note_on(0, 50, 0.3), note_on(0, 62, 0.2)});
    EXPECT_EQ(sounding_keys(state), (std::vector{50, 62}));
    EXPECT_EQ(state.counters.stolen_notes, 0U);
}

TEST(Chord, AsManyNotesSoundAsAnyChoiceAllows) {
    std::mt19937_64 random(11);
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<int> keys(2 + random() % 4);
        for (auto& key : keys) key = 28 + static_cast<int>(random() % 36);
        std::sort(keys.begin(), keys.end());
        keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
        std::shuffle(keys.begin(), keys.end(), random);
        std::vector<InstrumentEvent> events;
        for (const int key : keys) events.push_back(note_on(0, key, 0.2));
        std::vector<bool> taken(four_strings().courses.size(), false);
        const std::size_t most = most_notes(keys, 0, taken);
        EXPECT_EQ(sounding_keys(played(events)).size(), most) << testing::PrintToString(keys);
    }
}

}  // namespace
}  // namespace jawari
