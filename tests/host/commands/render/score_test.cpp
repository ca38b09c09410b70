#include "commands/render/score.h"

#include <gtest/gtest.h>

#include "support/midi_bytes.h"

namespace jawari::host {
namespace {

using namespace jawari::test;
using Type = InstrumentEventType;

/// A tick is a millisecond.
MidiFile file_of(const std::vector<std::pair<std::uint32_t, Bytes>>& events) {
    Bytes track;
    for (const auto& [delta, bytes] : events) append_event(track, delta, bytes);
    append_event(track, 0, end_of_track);
    return parse_midi(file_with_track(track, 500)).value();
}

ScoreRules by_program() {
    ScoreRules rules;
    rules.choose = [](int channel, int bank, int program) -> std::optional<std::string> {
        if (channel == 9 || program == 99) return std::nullopt;
        return "preset " + std::to_string(bank) + "/" + std::to_string(program);
    };
    return rules;
}

std::size_t count(const ScorePart& part, Type type) {
    std::size_t found = 0;
    for (const TimedEvent& timed : part.events) found += timed.event.type == type ? 1 : 0;
    return found;
}

TEST(Score, OnePartTakesAllChannels) {
    ScoreRules rules;
    rules.preset = "p";
    rules.parameters = {{ParameterId::PalmMute, 0.25}};
    const Score score = make_score(
        file_of({{100, {0x90, 60, 100}}, {0, {0xC5, 3}}, {50, {0x95, 62, 100}}, {50, {0x85, 62, 0}}}), 48000,
        rules);
    ASSERT_EQ(score.parts.size(), 1U);
    const ScorePart& part = score.parts[0];
    EXPECT_EQ(part.preset, "p");
    EXPECT_EQ(part.notes, 2U);
    ASSERT_EQ(part.events.size(), 4U);
    EXPECT_EQ(part.events[0].event.type, Type::SetParameter);
    EXPECT_EQ(part.events[0].event.channel, -1);
    EXPECT_EQ(part.events[0].event.value, 0.25);
    EXPECT_EQ(part.events[1].frame, 4800U);
    EXPECT_EQ(part.events[2].event.channel, 5);
    EXPECT_EQ(part.events[3].frame, 9600U);
    EXPECT_EQ(score.end_frame, 9600U);
    EXPECT_EQ(score.program_changes, 1U);
}

TEST(Score, AChannelIsAPartForEachOfItsPrograms) {
    const Score score = make_score(file_of({{0, {0xC0, 5}},
                                            {0, {0x90, 60, 100}},
                                            {10, {0xB0, 0, 2}},
                                            {0, {0xC0, 7}},
                                            {0, {0x90, 62, 100}},
                                            {10, {0x80, 60, 64}},
                                            {0, {0xB0, 64, 127}},
                                            {0, {0xC0, 5}},
                                            {0, {0x90, 64, 100}},
                                            {0, {0x91, 65, 100}}}),
                                   48000, by_program());
    ASSERT_EQ(score.parts.size(), 4U);
    EXPECT_EQ(score.parts[0].preset, "preset 0/5");
    EXPECT_EQ(score.parts[1].preset, "preset 256/7");
    EXPECT_EQ(score.parts[2].preset, "preset 256/5");  // the bank holds until it is changed
    EXPECT_EQ(score.parts[3].preset, "preset 0/0");
    EXPECT_EQ(score.parts[3].channel, 1);
    for (const ScorePart& part : score.parts) EXPECT_EQ(part.notes, 1U);
}

TEST(Score, WhatSoundsHearsItsNoteOffAfterAProgramChange) {
    const Score score = make_score(file_of({{0, {0x90, 60, 100}},
                                            {10, {0xC0, 7}},
                                            {0, {0x90, 62, 100}},
                                            {10, {0x80, 60, 64}},
                                            {0, {0xB0, 64, 127}},
                                            {0, {0x91, 65, 100}}}),
                                   48000, by_program());
    ASSERT_EQ(score.parts.size(), 3U);
    for (const std::size_t part : {0U, 1U}) {
        EXPECT_EQ(count(score.parts[part], Type::NoteOn), 1U);
        EXPECT_EQ(count(score.parts[part], Type::NoteOff), 1U);
        EXPECT_EQ(count(score.parts[part], Type::Sustain), 1U);
    }
    EXPECT_EQ(score.parts[2].events.size(), 1U);
}

TEST(Score, ChannelsWithoutAPresetAreSilentAndCounted) {
    const Score score =
        make_score(file_of({{0, {0x99, 36, 100}}, {0, {0xC0, 99}}, {0, {0x90, 60, 100}}, {0, {0x90, 62, 0}}}),
                   48000, by_program());
    EXPECT_TRUE(score.parts.empty());
    EXPECT_EQ(score.silent_notes, 2U);
}

TEST(Score, TheEndLetsGoOfEverything) {
    ScoreRules rules;
    rules.preset = "p";
    Score score = make_score(file_of({{0, {0xB3, 64, 127}}, {0, {0x93, 60, 100}}, {100, {0x93, 62, 100}}}),
                             48000, rules);
    end_notes(score);
    const auto& events = score.parts.at(0).events;
    ASSERT_EQ(events.size(), 5U);
    EXPECT_EQ(events[3].event.type, Type::Sustain);
    EXPECT_EQ(events[3].event.value, 0);
    EXPECT_EQ(events[4].event.type, Type::AllNotesOff);
    EXPECT_EQ(events[4].event.channel, 3);
    EXPECT_EQ(events[4].frame, 4800U);
}

TEST(Score, InGuitarModeOtherChannelsAreSilent) {
    ScoreRules rules;
    rules.preset = "guitar";
    rules.interpreter.guitar_channel = 2;
    rules.interpreter.guitar_strings = 2;
    rules.interpreter.guitar_string = {1, 0};
    const Score score = make_score(
        file_of({{0, {0x90, 60, 100}}, {0, {0x92, 60, 100}}, {0, {0x93, 55, 100}}, {0, {0x94, 50, 100}}}),
        48000, rules);
    ASSERT_EQ(score.parts.size(), 1U);
    EXPECT_EQ(score.parts[0].play, PlayMode::Guitar);
    EXPECT_EQ(score.silent_notes, 2U);
    ASSERT_EQ(score.parts[0].events.size(), 2U);
    EXPECT_EQ(score.parts[0].events[0].event.string, 1);
    EXPECT_EQ(score.parts[0].events[1].event.string, 0);
}

TEST(Score, AnMpeZoneIsOnePart) {
    const Score score = make_score(file_of({{0, {0xB0, 101, 0}},
                                            {0, {0xB0, 100, 6}},
                                            {0, {0xB0, 6, 15}},
                                            {0, {0xC0, 5}},
                                            {0, {0x91, 60, 100}},
                                            {0, {0x9A, 62, 100}},
                                            {0, {0xEA, 0, 0}}}),
                                   48000, by_program());
    ASSERT_EQ(score.parts.size(), 1U);
    EXPECT_EQ(score.parts[0].preset, "preset 0/5");
    EXPECT_EQ(score.parts[0].notes, 2U);
    EXPECT_EQ(count(score.parts[0], Type::Bend), 1U);
}

}  // namespace
}  // namespace jawari::host
