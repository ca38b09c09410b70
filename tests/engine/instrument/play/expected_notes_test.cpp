// Notes that a block will begin, foretold: against what begins when it is rendered.
#include "jawari/instrument/expected_notes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <vector>

#include "jawari/instrument/compile.h"
#include "jawari/instrument/render.h"
#include "support/bass_instrument.h"

namespace jawari {
namespace {

const InstrumentModel& bass_to_foretell() {
    static const InstrumentModel model = compile_instrument(test::bass_instrument(), 48000).value();
    return model;
}

std::vector<ExpectedNote> foretold(InstrumentState& state, const std::vector<InstrumentEvent>& events) {
    std::array<ExpectedNote, 64> room;
    const std::size_t count = expected_notes(bass_to_foretell(), state, events, room);
    return {room.begin(), room.begin() + static_cast<std::ptrdiff_t>(count)};
}

void play_block(InstrumentState& state, const std::vector<InstrumentEvent>& events) {
    std::vector<double> output(16);
    render_instrument(bass_to_foretell(), state, events, output.data(), output.size());
}

/// Keys, releases and the pedal, one after the other in frames that may be the same.
std::vector<InstrumentEvent> any_events(std::mt19937& random) {
    std::vector<InstrumentEvent> events;
    std::size_t frame = 0;
    for (std::size_t i = 0; i < random() % 6; ++i) {
        frame = std::min<std::size_t>(15, frame + random() % 3);
        const int key = 27 + 3 * static_cast<int>(random() % 9);  // few, so that releases meet held notes
        switch (random() % 8) {
            case 0:
                events.push_back(set_sustain_pedal(frame, random() % 2 == 0));
                break;
            case 1:
            case 2:
            case 3:
                events.push_back(note_off(frame, key));
                break;
            default:
                events.push_back(note_on(frame, key, 0.3));
                break;
        }
    }
    return events;
}

TEST(ExpectedNotes, AreAsManyAsBegin) {
    std::mt19937 random(5);
    InstrumentState state = make_instrument_state(bass_to_foretell());
    std::size_t all = 0;
    for (int block = 0; block < 600; ++block) {
        const std::vector<InstrumentEvent> events = any_events(random);
        const std::size_t count = foretold(state, events).size();
        const std::uint64_t before = state.note_order;  // a course has one string
        play_block(state, events);
        ASSERT_EQ(count, state.note_order - before) << block;
        all += count;
    }
    EXPECT_GT(all, 300U);
}

TEST(ExpectedNotes, TakeTheStringsThatRenderingGivesThem) {
    std::mt19937 random(6);
    InstrumentState state = make_instrument_state(bass_to_foretell());
    std::size_t compared = 0;
    for (int block = 0; block < 600; ++block) {
        std::vector<InstrumentEvent> events = any_events(random);
        // A chord may move to other strings: notes of one frame are left out of this comparison.
        for (std::size_t i = 0; i < events.size(); ++i) events[i].frame = i;
        const std::vector<ExpectedNote> notes = foretold(state, events);
        std::array<std::uint64_t, 4> order{};
        for (std::size_t c = 0; c < order.size(); ++c) order[c] = state.courses[c].held.order;
        play_block(state, events);
        for (std::size_t c = 0; c < order.size(); ++c) {
            const bool begins = state.courses[c].held.order != order[c];
            const bool expected = std::any_of(notes.begin(), notes.end(),
                                              [&](const ExpectedNote& note) { return note.string == c; });
            if (order[c] == 0 && state.courses[c].held.order == 0)
                continue;  // the first note of all, or none
            ASSERT_EQ(begins, expected) << block << ", string " << c;
            ++compared;
        }
        for (const ExpectedNote& note : notes) {
            const auto& stopped = bass_to_foretell().strings[note.string].stopped;
            EXPECT_TRUE(std::any_of(events.begin(), events.end(), [&](const InstrumentEvent& event) {
                return event.key == stopped[note.fret].key;
            }));
        }
    }
    EXPECT_GT(compared, 1000U);
}

TEST(ExpectedNotes, LeaveTheStateAsItIs) {
    std::mt19937 random(7);
    InstrumentState asked = make_instrument_state(bass_to_foretell());
    InstrumentState unasked = make_instrument_state(bass_to_foretell());
    std::vector<double> first(16), second(16);
    for (int block = 0; block < 100; ++block) {
        const std::vector<InstrumentEvent> events = any_events(random);
        foretold(asked, events);
        render_instrument(bass_to_foretell(), asked, events, first.data(), first.size());
        render_instrument(bass_to_foretell(), unasked, events, second.data(), second.size());
        ASSERT_EQ(first, second) << block;
        ASSERT_EQ(held_notes(asked), held_notes(unasked));
    }
}

TEST(ExpectedNotes, StopWhereThereIsNoRoom) {
    InstrumentState state = make_instrument_state(bass_to_foretell());
    std::array<ExpectedNote, 2> room;
    const std::vector<InstrumentEvent> events{note_on(0, 28, 1), note_on(0, 40, 1), note_on(0, 45, 1)};
    EXPECT_EQ(expected_notes(bass_to_foretell(), state, events, room), 2U);
    const std::vector<InstrumentEvent> nonsense{note_on(0, 300, 1), note_on(0, 40, 2), note_on(0, 40, 1, 77)};
    EXPECT_EQ(expected_notes(bass_to_foretell(), state, nonsense, room), 0U);
}

}  // namespace
}  // namespace jawari
