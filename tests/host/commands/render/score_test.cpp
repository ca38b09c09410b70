#include "commands/render/score.h"

#include <gtest/gtest.h>

#include <map>

#include "commands/render/note_offs.h"
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
    rules.choose = [](int bank, int program) -> std::optional<std::string> {
        if (program == 99) return std::nullopt;
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

/// Program, controllers and a bend; a note from 100 to 400 ms, one from 300 to 500 ms, one from 600 ms on.
MidiFile file_to_cut() {
    return file_of({{0, {0xC0, 9}},
                    {0, {0xB0, 7, 100}},
                    {50, {0xB0, 7, 50}},
                    {0, {0xE0, 0, 96}},
                    {50, {0x90, 60, 100}},
                    {200, {0x90, 62, 100}},
                    {100, {0x80, 60, 64}},
                    {100, {0x80, 62, 64}},
                    {100, {0xC0, 10}},
                    {0, {0x90, 64, 100}},
                    {400, {0x80, 64, 64}}});
}

TEST(Score, AnExcerptHasTheSettingsOfWhatComesBeforeButNotItsNotes) {
    ScoreRules rules = by_program();
    rules.excerpt = {350 * 48, 700 * 48};
    const Score score = make_score(file_to_cut(), 48000, rules);
    ASSERT_EQ(score.parts.size(), 1U);
    EXPECT_EQ(score.parts[0].preset, "preset 0/10");
    EXPECT_EQ(score.parts[0].notes, 1U);
    EXPECT_EQ(score.cut_notes, 2U);
    EXPECT_EQ(score.program_changes, 1U);
    EXPECT_EQ(score.end_frame, 350U * 48);
    EXPECT_EQ(score.whole_frames, 1000U * 48);
    std::vector<double> volumes;
    for (const TimedEvent& timed : score.parts[0].events) {
        if (timed.event.type == Type::NoteOn) {
            EXPECT_EQ(timed.frame, 250U * 48);
        }
        if (timed.event.type == Type::Bend) {
            EXPECT_NEAR(timed.event.value, 1, 1e-3);
        }
        if (timed.event.type == Type::SetParameter) volumes.push_back(timed.event.value);
    }
    EXPECT_EQ(count(score.parts[0], Type::Bend), 1U);
    EXPECT_EQ(volumes.size(), 1U);
}

TEST(Score, AnExcerptPlaysTheProgramThatWasChosenBeforeIt) {
    ScoreRules rules = by_program();
    rules.excerpt.begin = 200 * 48;
    const Score score = make_score(file_to_cut(), 48000, rules);
    ASSERT_EQ(score.parts.size(), 2U);
    EXPECT_EQ(score.parts[0].preset, "preset 0/9");
    EXPECT_EQ(score.cut_notes, 1U);
    EXPECT_EQ(score.end_frame, 800U * 48);
}

TEST(Score, ANoteAtTheBeginningOfAnExcerptIsInItAndOneAtItsEndIsNot) {
    ScoreRules rules = by_program();
    rules.excerpt = {300 * 48, 600 * 48};
    const Score score = make_score(file_to_cut(), 48000, rules);
    ASSERT_EQ(score.parts.size(), 1U);
    EXPECT_EQ(score.parts[0].notes, 1U);
    for (const TimedEvent& timed : score.parts[0].events)
        if (timed.event.type == Type::NoteOn) {
            EXPECT_EQ(timed.event.key, 62);
        }
}

TEST(Score, WhatIsIgnoredOutsideAnExcerptIsNotCounted) {
    const MidiFile file = file_of({{0, {0xB0, 91, 1}},
                                   {0, {0x99, 36, 100}},
                                   {500, {0xB0, 91, 2}},
                                   {0, {0x99, 36, 100}},
                                   {500, {0xB0, 91, 3}},
                                   {0, {0x99, 36, 100}}});
    ScoreRules rules = by_program();
    rules.excerpt = {400 * 48, 600 * 48};
    const Score score = make_score(file, 48000, rules);
    ASSERT_EQ(score.ignored.size(), 1U);
    EXPECT_EQ(score.ignored[0].count, 1U);
    EXPECT_EQ(score.silent_notes, 1U);
    EXPECT_TRUE(score.parts.empty());
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

/// Lengths of the notes of a part, by their keys [frames].
std::multimap<int, std::uint64_t> note_ends(const ScorePart& part) {
    std::multimap<int, std::uint64_t> ends;
    for (const TimedEvent& timed : part.events)
        if (timed.event.type == Type::NoteOff) ends.emplace(timed.event.key, timed.frame);
    return ends;
}

MidiFile completed(MidiFile file) {
    file.events = with_note_offs(file.events);
    return file;
}

TEST(Score, ANoteWithoutItsNoteOffEndsWithTheNextOfItsKey) {
    ScoreRules rules;
    rules.preset = "p";
    // The first note is never ended: without more ado the matching would hold the key to the end.
    const Score score = make_score(completed(file_of({{0, {0x90, 60, 100}},
                                                      {100, {0x90, 60, 100}},
                                                      {100, {0x80, 60, 64}},
                                                      {100, {0x90, 60, 100}},
                                                      {100, {0x80, 60, 64}}})),
                                   48000, rules);
    EXPECT_EQ(note_ends(score.parts.at(0)),
              (std::multimap<int, std::uint64_t>{{60, 4800}, {60, 9600}, {60, 19200}}));
    // Whereas notes that overlap are both ended.
    const Score overlap = make_score(
        completed(file_of(
            {{0, {0x90, 60, 100}}, {100, {0x90, 60, 100}}, {100, {0x80, 60, 64}}, {100, {0x80, 60, 64}}})),
        48000, rules);
    EXPECT_EQ(note_ends(overlap.parts.at(0)), (std::multimap<int, std::uint64_t>{{60, 14400}}));
}

TEST(Score, TempoAndMutedChannels) {
    ScoreRules rules;
    rules.preset = "p";
    rules.tempo = 0.5;
    rules.muted = 1U << 5U;
    const Score score = make_score(
        file_of({{100, {0x90, 60, 100}}, {0, {0x95, 62, 100}}, {100, {0x80, 60, 64}}}), 48000, rules);
    ASSERT_EQ(score.parts.size(), 1U);
    EXPECT_EQ(score.parts[0].notes, 1U);
    EXPECT_EQ(score.muted_notes, 1U);
    EXPECT_EQ(score.silent_notes, 0U);
    EXPECT_EQ(score.parts[0].events[0].frame, 9600U);
    EXPECT_EQ(score.end_frame, 19200U);
}

TEST(Score, PortsHaveChannelsOfTheirOwn) {
    const auto make = [](const ScoreRules& rules) {
        return make_score(file_of({{0, {0xC0, 5}},
                                   {0, {0x90, 60, 100}},
                                   {0, {0xFF, 0x21, 1, 1}},
                                   {0, {0xE0, 0, 0}},
                                   {0, {0x90, 61, 100}},
                                   {0, {0xFF, 0x21, 1, 0}},
                                   {10, {0x90, 62, 100}}}),
                          48000, rules);
    };
    const Score score = make(by_program());
    ASSERT_EQ(score.parts.size(), 2U);
    EXPECT_EQ(score.parts[0].preset, "preset 0/5");
    EXPECT_EQ(score.parts[0].notes, 2U);
    EXPECT_EQ(count(score.parts[0], Type::Bend), 0U);
    EXPECT_EQ(score.parts[1].preset, "preset 0/0");
    EXPECT_EQ(score.parts[1].port, 1);
    EXPECT_EQ(count(score.parts[1], Type::Bend), 1U);
    ScoreRules one;
    one.preset = "p";
    EXPECT_EQ(make(one).parts.size(), 2U);
}

TEST(Score, WhatIsIgnoredIsCountedByKind) {
    ScoreRules rules;
    rules.preset = "p";
    const Score score = make_score(file_of({{0, {0xB0, 91, 40}},
                                            {0, {0xB5, 91, 40}},
                                            {0, {0xB0, 7, 100}},
                                            {0, {0xB0, 39, 100}},
                                            {0, {0xB0, 99, 1}},
                                            {0, {0xB0, 98, 8}},
                                            {0, {0xB0, 6, 8}},
                                            {0, {0xF0, 3, 0x42, 1, 0xF7}},
                                            {0, {0xF7, 1, 0xF8}}}),
                                   48000, rules);
    std::vector<std::string> kinds;
    for (const IgnoredKind& kind : score.ignored)
        kinds.push_back(std::to_string(kind.count) + " " + kind.what);
    EXPECT_EQ(kinds, (std::vector<std::string>{"1 NRPN 1/8", "1 bytes for other devices (F7)",
                                               "1 controller 39 (fine half)", "2 controller 91 (reverb)",
                                               "1 system exclusive: Korg"}));
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
