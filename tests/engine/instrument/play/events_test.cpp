// What the event factories mean: each against what a listener can tell from its effect.
#include "jawari/instrument/events.h"

#include <gtest/gtest.h>

#include "jawari/instrument/compile.h"
#include "support/small_instrument.h"

namespace jawari {
namespace {

using test::play;

const InstrumentModel& small_model() {
    static const InstrumentModel model = compile_instrument(test::small_instrument(), 48000).value();
    return model;
}

InstrumentState after(const std::vector<InstrumentEvent>& events) {
    InstrumentState state = make_instrument_state(small_model());
    play(small_model(), state, events, 8);
    return state;
}

TEST(EventFactories, NotesHaveKeyVelocityChannelAndString) {
    const InstrumentState chosen = after({note_on(0, 45, 0.75, 3)});
    EXPECT_EQ(chosen.courses[1].held.key, 45);
    EXPECT_EQ(chosen.courses[1].held.velocity, 0.75);
    EXPECT_EQ(chosen.courses[1].held.channel, 3);
    EXPECT_EQ(held_notes(after({note_on(0, 45, 0.75, 3), note_off(4, 45)})), 1U);  // another channel's key
    EXPECT_EQ(held_notes(after({note_on(0, 45, 0.75, 3), note_off(4, 45, 0.1, 3)})), 0U);
    // Nobody has key 28 but the first course: told to play it on string 2, the note is ignored.
    EXPECT_EQ(after({note_on(0, 28, 0.5)}).counters.ignored_notes, 0U);
    EXPECT_EQ(after({note_on_string(0, 2, 28, 0.5)}).counters.ignored_notes, 1U);
    EXPECT_EQ(after({note_on_string(0, 1, 28, 0.5)}).counters.ignored_notes, 0U);
}

TEST(EventFactories, AreHeardFromTheirFrameOn) {
    InstrumentState late = make_instrument_state(small_model());
    InstrumentState soon = make_instrument_state(small_model());
    const auto a = play(small_model(), late, {note_on(37, 45, 0.75)}, 400);
    const auto b = play(small_model(), soon, {note_on(0, 45, 0.75)}, 400);
    EXPECT_EQ(a.left[36], 0);
    EXPECT_NE(a.left[37], 0);
    EXPECT_EQ(a.left[37], b.left[0]);
}

TEST(EventFactories, BendsAndPressuresAreOfTheNoteOrTheChannel) {
    const InstrumentState state =
        after({note_on(0, 45, 0.5, 2), bend_channel(1, -1.5, 2), bend_note(2, 45, 2.5, 2),
               press_channel(3, 0.25, 2), press_note(4, 45, 0.75, 2)});
    EXPECT_EQ(state.channels[2].bend, -1.5);
    EXPECT_EQ(state.channels[2].pressure, 0.25);
    EXPECT_EQ(state.courses[1].held.bend, 2.5);
    EXPECT_EQ(state.courses[1].held.pressure, 0.75);
    EXPECT_EQ(state.channels[0].bend, 0);
}

TEST(EventFactories, PedalsAndTimbreAreOfTheChannel) {
    const InstrumentState state =
        after({set_sustain_pedal(0, true, 4), set_soft_pedal(0, 0.5, 4), set_timbre(0, 0.9, 4)});
    EXPECT_TRUE(state.channels[4].sustain);
    EXPECT_EQ(state.channels[4].soft, 0.5);
    EXPECT_EQ(state.channels[4].timbre, 0.9);
    EXPECT_FALSE(state.channels[0].sustain);
    const InstrumentState neutral =
        after({set_sustain_pedal(0, true, 4), set_soft_pedal(0, 0.5, 4), reset_controllers(1, 4)});
    EXPECT_FALSE(neutral.channels[4].sustain);
    EXPECT_EQ(neutral.channels[4].soft, 0);
}

TEST(EventFactories, ParametersAreOfOneChannelOrOfAll) {
    constexpr auto pan = static_cast<std::size_t>(ParameterId::Pan);
    const InstrumentState one = after({set_parameter(0, ParameterId::Pan, -0.5, 5)});
    EXPECT_EQ(one.channels[5].parameters[pan], -0.5);
    EXPECT_EQ(one.channels[6].parameters[pan], 0);
    const InstrumentState all = after({set_parameter(0, ParameterId::Pan, -0.5, every_channel)});
    for (const ChannelState& channel : all.channels) EXPECT_EQ(channel.parameters[pan], -0.5);
}

TEST(EventFactories, AllNotesOffLeavesThePedalAndAllSoundOffNothing) {
    const std::vector<InstrumentEvent> pedalled{set_sustain_pedal(0, true, 1), note_on(0, 45, 0.5, 1)};
    auto events = pedalled;
    events.push_back(all_notes_off(1, 1));
    EXPECT_EQ(held_notes(after(events)), 1U);
    events.push_back(all_sound_off(1, 1));
    InstrumentState state = after(events);
    EXPECT_EQ(held_notes(state), 0U);
    play(small_model(), state, {}, 200);
    EXPECT_EQ(sounding_voices(state), 0U);
}

}  // namespace
}  // namespace jawari
