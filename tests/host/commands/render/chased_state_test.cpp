#include "commands/render/chased_state.h"

#include <gtest/gtest.h>

namespace jawari::host {
namespace {

using Type = InstrumentEventType;

TEST(ChasedState, TheLastSettingOfEachKindAndChannelIsKept) {
    ChasedState state;
    state.add(bend_channel(0, 1, 3));
    state.add(bend_channel(0, -2, 3));
    state.add(bend_channel(0, 5, 4));
    state.add(set_sustain_pedal(0, true, 3));
    state.add(set_parameter(0, ParameterId::Volume, 0.5, 3));
    state.add(set_parameter(0, ParameterId::Pan, 0.1, 3));
    state.add(set_parameter(0, ParameterId::Volume, 0.25, 3));
    ASSERT_EQ(state.events().size(), 5U);
    EXPECT_EQ(state.events()[0].value, -2);
    EXPECT_EQ(state.events()[1].channel, 4);
    EXPECT_EQ(state.events()[2].type, Type::Sustain);
    EXPECT_EQ(state.events()[3].parameter, ParameterId::Pan);
    EXPECT_EQ(state.events()[4].value, 0.25);
}

TEST(ChasedState, NotesLeaveNothing) {
    ChasedState state;
    state.add(note_on(0, 60, 1));
    state.add(bend_note(0, 60, 2));
    state.add(press_note(0, 60, 1));
    state.add(note_off(0, 60));
    EXPECT_TRUE(state.events().empty());
}

TEST(ChasedState, AResetLeavesTheParametersOfItsChannelAndAllOfOthers) {
    ChasedState state;
    state.add(press_channel(0, 1, 2));
    state.add(set_timbre(0, 1, 2));
    state.add(set_parameter(0, ParameterId::Volume, 0.5, 2));
    state.add(press_channel(0, 1, 5));
    state.add({.type = Type::ResetControllers, .channel = 2});
    ASSERT_EQ(state.events().size(), 2U);
    EXPECT_EQ(state.events()[0].type, Type::SetParameter);
    EXPECT_EQ(state.events()[1].channel, 5);
}

TEST(ChasedState, ASettingOfAllChannelsReplacesThoseOfEach) {
    ChasedState state;
    state.add(set_parameter(0, ParameterId::Volume, 0.5, 2));
    state.add(set_parameter(0, ParameterId::Volume, 0.75, every_channel));
    ASSERT_EQ(state.events().size(), 1U);
    EXPECT_EQ(state.events()[0].value, 0.75);
}

}  // namespace
}  // namespace jawari::host
