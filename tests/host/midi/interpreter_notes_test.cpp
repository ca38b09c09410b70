// Which note-off ends which note, where keys sound, sostenuto, drums, and messages to the whole instrument.
// Expected values: MIDI 1.0 Detailed Specification 4.2, General MIDI System Level 1 and 2, MIDI Tuning
// Standard (1992, CA-020, CA-021), the GS and XG formats.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>

#include "midi/system_message.h"
#include "support/interpret.h"

namespace jawari::host {
namespace {

using test::Player;
using test::value_of;
using Type = InstrumentEventType;

std::size_t count(const std::vector<InstrumentEvent>& events, Type type) {
    return static_cast<std::size_t>(
        std::count_if(events.begin(), events.end(), [type](const auto& e) { return e.type == type; }));
}

/// All events of a system exclusive message, without F0 and F7.
std::vector<InstrumentEvent> exclusive(Player& player, const std::vector<std::uint8_t>& bytes) {
    std::vector<InstrumentEvent> all;
    for (const ChannelMessage& message : decode_exclusive(bytes).messages) {
        const auto events = player.send(message.status, message.data1, message.data2);
        all.insert(all.end(), events.begin(), events.end());
    }
    return all;
}

TEST(NoteOffs, EndTheOldestNoteOfTheirKey) {
    // A queue of notes for each key decides: the instrument hears the off that empties it.
    Player player;
    std::mt19937 random(7);
    std::array<std::deque<int>, 3> open;
    for (int i = 0; i < 20000; ++i) {
        const std::size_t key = random() % open.size();
        const bool on = random() % 2 == 0;
        const auto events = player.send(on ? 0x90 : 0x80, static_cast<int>(60 + key), 64);
        if (on) {
            open[key].push_back(i);
            EXPECT_EQ(count(events, Type::NoteOn), 1U);
            EXPECT_EQ(count(events, Type::NoteOff), 0U);
        } else if (!open[key].empty()) {
            open[key].pop_front();
            EXPECT_EQ(count(events, Type::NoteOff), open[key].empty() ? 1U : 0U);
        }
    }
}

TEST(NoteOffs, AreForgottenWithTheNotes) {
    for (const int mode : {120, 123, 124, 127}) {
        Player player;
        player.send(0x90, 60, 64);
        player.send(0x90, 60, 64);
        player.control(1, mode, 0);
        player.send(0x90, 60, 64);
        EXPECT_EQ(count(player.send(0x80, 60, 64), Type::NoteOff), 1U) << mode;
    }
}

TEST(NoteOffs, OfMonoNotesBelongToTheirNotes) {
    Player player;
    player.control(1, 126, 1);
    player.send(0x90, 60, 64);
    EXPECT_EQ(count(player.send(0x90, 62, 64), Type::NoteOff), 1U);
    player.send(0x90, 60, 64);  // again, before its first note-off
    EXPECT_EQ(count(player.send(0x80, 60, 64), Type::NoteOff), 0U);
    EXPECT_EQ(count(player.send(0x80, 60, 64), Type::NoteOff), 1U);
}

TEST(CoarseTuning, MovesTheNextNotes) {
    Player player;
    player.send(0x90, 57, 64);
    player.rpn(1, 2, 64 + 5);
    EXPECT_EQ(player.send(0x80, 57, 64)[0].key, 57);  // the note that sounds stays where it is
    EXPECT_EQ(player.send(0x90, 57, 64)[0].key, 62);
    EXPECT_EQ(player.send(0xA0, 57, 64)[0].key, 62);
    player.rpn(1, 2, 64 - 12);
    const auto again = player.send(0x90, 57, 64);  // its key is down: nobody could end it afterwards
    ASSERT_EQ(again.size(), 2U);
    EXPECT_EQ(again[0].type, Type::NoteOff);
    EXPECT_EQ(again[0].key, 62);
    EXPECT_EQ(again[1].key, 45);
    EXPECT_EQ(player.send(0x91, 57, 64)[0].key, 57);  // another channel
    EXPECT_TRUE(player.send(0x90, 5, 64).empty());    // below key 0
    EXPECT_TRUE(player.actions.ignored);
    player.control(1, 101, 0);
    player.control(1, 100, 2);
    player.control(1, 96, 0);
    EXPECT_EQ(player.send(0x90, 70, 64)[0].key, 70 - 11);  // an increment is a semitone
}

TEST(Transposition, LeavesDrumsAlone) {
    InterpreterSettings settings;
    settings.transpose_semitones = -3;
    Player player(settings);
    EXPECT_EQ(player.send(0x90, 60, 64)[0].key, 57);
    EXPECT_EQ(player.send(0x99, 36, 64)[0].key, 36);
}

TEST(MasterTuning, IsPartOfEveryBendAndKey) {
    Player player;
    exclusive(player, {0x7F, 0x7F, 0x04, 0x03, 0x00, 0x60});  // +50 cents
    EXPECT_EQ(value_of(player.bend(3, 8192), Type::Bend, 2), 0.5);
    exclusive(player, {0x7F, 0x7F, 0x04, 0x04, 0x00, 0x42});
    EXPECT_EQ(player.send(0x90, 60, 64)[0].key, 62);
    exclusive(player, {0x41, 0x10, 0x42, 0x12, 0x40, 0x00, 0x05, 0x3E, 0x7D});  // GS: -2
    EXPECT_EQ(player.send(0x90, 64, 64)[0].key, 62);
    exclusive(player, {0x41, 0x10, 0x42, 0x12, 0x40, 0x00, 0x00, 0, 6, 5, 8, 0x2D});  // GS: +60 cents
    EXPECT_NEAR(*value_of(player.bend(1, 8192), Type::Bend, 0), 0.6, 1e-4);
    exclusive(player, {0x43, 0x10, 0x4C, 0x00, 0x00, 0x00, 0, 1, 10, 8});  // XG: 0x1A8 is -60 cents
    EXPECT_NEAR(*value_of(player.bend(1, 8192), Type::Bend, 0), -0.6, 1e-4);
}

TEST(PortamentoControl, TheNextNoteSlidesFromTheGivenKeyAndEndsIt) {
    for (const bool mono : {false, true}) {
        Player player;
        if (mono) player.control(1, 126, 1);
        player.control(1, 5, 64);  // half a second, and the switch is off
        player.send(0x90, 60, 64);
        EXPECT_TRUE(player.control(1, 84, 60).empty());
        EXPECT_FALSE(player.actions.ignored);
        const auto events = player.send(0x90, 64, 64);
        std::vector<Type> types;
        for (const InstrumentEvent& event : events) types.push_back(event.type);
        ASSERT_EQ(types, (std::vector<Type>{Type::SetParameter, Type::SetParameter, Type::NoteOn,
                                            Type::NoteOff, Type::SetParameter, Type::SetParameter}));
        EXPECT_EQ(events[0].parameter, ParameterId::Legato);
        EXPECT_EQ(events[0].value, 1);
        EXPECT_EQ(events[1].parameter, ParameterId::SlideTime);
        EXPECT_NEAR(events[1].value, 0.5, 1e-9);
        EXPECT_EQ(events[2].key, 64);
        EXPECT_EQ(events[3].key, 60);
        EXPECT_EQ(events[4].value, 0);
        player.send(0x80, 64, 64);
        EXPECT_EQ(player.send(0x90, 67, 64).size(), 1U);  // of one note alone
    }
}

TEST(PortamentoControl, DoesNothingFromAKeyThatIsNotDown) {
    Player player;
    player.send(0x90, 60, 64);
    player.control(1, 84, 61);
    EXPECT_TRUE(player.actions.ignored);
    EXPECT_EQ(player.send(0x90, 64, 64).size(), 1U);
    player.control(1, 84, 64);
    player.send(0x80, 64, 64);
    EXPECT_EQ(player.send(0x90, 65, 64).size(), 1U);
    player.control(1, 84, 65);
    player.control(1, 121, 0);
    EXPECT_EQ(player.send(0x90, 66, 64).size(), 1U);
}

TEST(TuningStandard, KeysSoundWhereTheyAreTuned) {
    Player player;
    // Key 60 at 60.5, now; key 61 at 63 exactly.
    exclusive(player, {0x7F, 0x7F, 0x08, 0x02, 0, 2, 60, 60, 0x40, 0, 61, 63, 0, 0});
    const auto tuned = player.send(0x90, 60, 64);
    ASSERT_EQ(tuned.size(), 4U);  // the channel has the note's pitch when it begins
    EXPECT_EQ(tuned[0].type, Type::Bend);
    EXPECT_EQ(tuned[1].type, Type::NoteOn);
    EXPECT_EQ(tuned[1].key + tuned[0].value, 60.5);
    EXPECT_EQ(tuned[2].value, 0.0);
    EXPECT_EQ(tuned[3].key + tuned[3].value, 60.5);
    EXPECT_EQ(player.send(0x90, 61, 64)[0].key, 63);
    const auto bent = player.bend(1, 16383);  // 2 semitones for all, and for the key that is off its place
    ASSERT_EQ(bent.size(), 2U);
    EXPECT_EQ(bent[0].value, 2.0);
    EXPECT_EQ(bent[1].key + bent[1].value, 62.5);
    // A change while it sounds.
    const auto moved = exclusive(player, {0x7F, 0x7F, 0x08, 0x02, 0, 1, 60, 61, 0x20, 0});
    ASSERT_EQ(moved.size(), 1U);
    EXPECT_EQ(moved[0].key + moved[0].value, 61.25 + 2);
    EXPECT_EQ(player.send(0x80, 60, 64)[0].key, tuned[1].key);
}

TEST(TuningStandard, ProgramsDumpsAndOctaves) {
    Player player;
    std::vector<std::uint8_t> dump{0x7E, 0x7F, 0x08, 0x01, 5};
    dump.insert(dump.end(), 16, 'x');
    for (std::uint8_t key = 0; key < 128; ++key)
        dump.insert(dump.end(), {static_cast<std::uint8_t>(127 - key), 0, 0});
    dump.push_back(0);
    exclusive(player, dump);
    EXPECT_EQ(player.send(0x90, 60, 64)[0].key, 60);  // another program plays
    player.rpn(1, 3, 5);
    EXPECT_EQ(player.send(0x90, 50, 64)[0].key, 77);
    // D of channels 1 and 16 by -25 cents (64 is none), in one byte; then of channel 2 by +50, in two.
    std::vector<std::uint8_t> octave{0x7E, 0x7F, 0x08, 0x08, 2, 0, 1};
    for (int i = 0; i < 12; ++i) octave.push_back(i == 2 ? 64 - 25 : 64);
    Player second;
    exclusive(second, octave);
    EXPECT_NEAR(second.send(0x90, 62, 64)[0].value, -0.25, 1e-4);
    EXPECT_NEAR(second.send(0x9F, 74, 64)[0].value, -0.25, 1e-4);
    EXPECT_EQ(second.send(0x90, 60, 64).size(), 1U);
    EXPECT_EQ(second.send(0x91, 62, 64).size(), 1U);
    std::vector<std::uint8_t> fine{0x7F, 0x7F, 0x08, 0x09, 0, 0, 2};
    for (int i = 0; i < 12; ++i) fine.insert(fine.end(), {static_cast<std::uint8_t>(i == 2 ? 96 : 64), 0});
    exclusive(second, fine);
    const auto now = second.send(0x91, 50, 64);
    EXPECT_NEAR(now[1].key + now[0].value, 50.5, 1e-4);
}

TEST(Sostenuto, HoldsWhatIsDownWhenItGoesDown) {
    Player player;
    player.send(0x90, 60, 64);
    player.control(1, 66, 127);
    player.send(0x90, 64, 64);
    EXPECT_TRUE(player.send(0x80, 60, 64).empty());
    EXPECT_EQ(count(player.send(0x80, 64, 64), Type::NoteOff), 1U);
    EXPECT_TRUE(player.control(1, 66, 127).empty());
    const auto up = player.control(1, 66, 0);
    ASSERT_EQ(up.size(), 1U);
    EXPECT_EQ(up[0].key, 60);
    EXPECT_TRUE(player.control(1, 66, 0).empty());
    player.send(0x90, 60, 64);
    player.control(1, 66, 127);
    EXPECT_TRUE(player.control(1, 66, 0).empty());  // its key is down
    EXPECT_EQ(count(player.send(0x80, 60, 64), Type::NoteOff), 1U);
}

TEST(Sostenuto, AndHold2EndWithAReset) {
    Player player;
    EXPECT_EQ(value_of(player.control(1, 69, 127), Type::Sustain, 0), 1.0);
    EXPECT_EQ(value_of(player.control(1, 64, 0), Type::Sustain, 0), 1.0);  // the other pedal holds
    EXPECT_EQ(value_of(player.control(1, 69, 0), Type::Sustain, 0), 0.0);
    player.send(0x90, 60, 64);
    player.control(1, 66, 127);
    player.send(0x80, 60, 64);
    EXPECT_EQ(count(player.control(1, 121, 0), Type::NoteOff), 1U);
}

TEST(Portamento, SlidesInMonoModeAlone) {
    Player player;
    EXPECT_TRUE(player.control(1, 5, 64).empty());
    EXPECT_TRUE(player.control(1, 65, 127).empty());
    EXPECT_FALSE(player.actions.ignored);
    const auto mono = player.control(1, 126, 1);
    EXPECT_EQ(value_of(mono, Type::SetParameter, 0, ParameterId::Legato), 1.0);
    EXPECT_EQ(value_of(mono, Type::SetParameter, 0, ParameterId::SlideTime), 0.5);  // squared travel of 2 s
    const auto off = player.control(1, 65, 0);
    EXPECT_EQ(value_of(off, Type::SetParameter, 0, ParameterId::Legato), 0.0);
    EXPECT_EQ(value_of(off, Type::SetParameter, 0, ParameterId::SlideTime), 0.0);
}

bool drums(Player& player, int channel) {
    player.send(0xC0 + channel - 1, 0);
    return player.actions.program.unpitched;
}

TEST(Drums, ByChannelBankAndMessage) {
    Player plain;
    EXPECT_TRUE(drums(plain, 10));
    EXPECT_FALSE(drums(plain, 11));
    for (const int bank : {120, 126, 127}) {
        plain.control(3, 0, bank);
        EXPECT_TRUE(drums(plain, 3)) << bank;
    }
    plain.control(3, 0, 0);
    EXPECT_FALSE(drums(plain, 3));
    plain.control(10, 0, 0);
    EXPECT_TRUE(drums(plain, 10));
    plain.control(10, 0, 121);
    EXPECT_FALSE(drums(plain, 10));

    Player gs;
    exclusive(gs, {0x41, 0x10, 0x42, 0x12, 0x40, 0x00, 0x7F, 0x00, 0x41});
    gs.control(3, 0, 127);  // sounds of the MT-32
    EXPECT_FALSE(drums(gs, 3));
    exclusive(gs, {0x41, 0x10, 0x42, 0x12, 0x40, 0x1A, 0x15, 0x02, 0x0F});  // part A is channel 11
    EXPECT_TRUE(drums(gs, 11));
    exclusive(gs, {0x41, 0x10, 0x42, 0x12, 0x40, 0x10, 0x15, 0x00, 0x1B});  // part 0 is channel 10
    EXPECT_FALSE(drums(gs, 10));
    exclusive(gs, {0x41, 0x10, 0x42, 0x12, 0x40, 0x11, 0x15, 0x01, 0x19});  // part 1 is channel 1
    EXPECT_TRUE(drums(gs, 1));

    Player xg;
    exclusive(xg, {0x43, 0x10, 0x4C, 0, 0, 0x7E, 0});
    EXPECT_TRUE(drums(xg, 10));
    xg.control(10, 0, 0);  // a normal voice
    EXPECT_FALSE(drums(xg, 10));
    xg.control(4, 0, 64);  // effects
    EXPECT_TRUE(drums(xg, 4));
    exclusive(xg, {0x43, 0x10, 0x4C, 0x08, 0x05, 0x07, 0x02});
    EXPECT_TRUE(drums(xg, 6));
}

TEST(Resets, StartEveryChannelAnew) {
    const std::vector<std::vector<std::uint8_t>> resets{{0x7E, 0x7F, 0x09, 0x01},
                                                        {0x7E, 0x7F, 0x09, 0x03},
                                                        {0x41, 0x10, 0x42, 0x12, 0x40, 0, 0x7F, 0, 0x41},
                                                        {0x41, 0x10, 0x42, 0x12, 0, 0, 0x7F, 0, 0x01},
                                                        {0x43, 0x10, 0x4C, 0, 0, 0x7E, 0}};
    for (const auto& reset : resets) {
        Player player;
        player.rpn(1, 0, 12);
        player.rpn(1, 2, 70);
        player.bend(1, 0);
        player.control(1, 7, 0);
        player.control(1, 0, 5);
        exclusive(player, {0x7F, 0x7F, 0x04, 0x01, 0, 0});
        player.send(0x90, 60, 64);
        player.send(0x90, 60, 64);
        const auto events = exclusive(player, reset);
        EXPECT_TRUE(player.actions.programs_reset);
        for (int channel = 0; channel < 16; ++channel) {
            EXPECT_EQ(value_of(events, Type::Bend, channel), 0.0);
            EXPECT_NEAR(*value_of(events, Type::SetParameter, channel, ParameterId::Volume),
                        std::pow(0.5 + 0.5 * 36 / 63.0, 2), 1e-12);
            EXPECT_EQ(value_of(events, Type::SetParameter, channel, ParameterId::Expression), 1.0);
            EXPECT_EQ(value_of(events, Type::SetParameter, channel, ParameterId::Pan), 0.0);
        }
        EXPECT_EQ(count(events, Type::AllNotesOff), 16U);
        EXPECT_EQ(player.send(0x90, 60, 64)[0].key, 60);
        EXPECT_EQ(count(player.send(0x80, 60, 64), Type::NoteOff), 1U);
        EXPECT_EQ(value_of(player.bend(1, 0), Type::Bend, 0), -2.0);
        player.send(0xC0, 3);
        EXPECT_EQ(player.actions.program.bank, 0);
    }
}

TEST(SystemMessages, KindsThatAreIgnoredHaveNames) {
    const std::vector<std::pair<std::vector<std::uint8_t>, std::string>> kinds{
        {{0x41, 0x10, 0x42, 0x12, 0x40, 0x01, 0x30, 0x04, 0x0B}, "GS reverb"},
        {{0x41, 0x10, 0x42, 0x12, 0x40, 0x01, 0x38, 0x02, 0x05}, "GS chorus"},
        {{0x41, 0x10, 0x45, 0x12, 0x10, 0, 0, 'h', 'i'}, "Roland display"},
        {{0x43, 0x10, 0x4C, 0x02, 0x01, 0x00, 0x01}, "XG effects"},
        {{0x7F, 0x7F, 0x04, 0x02, 0, 0x40}, "master balance"},
        {{0x7F, 0x7F, 0x01, 0x01, 0, 0, 0, 0}, "MIDI time code"},
        {{0x7E, 0x7F, 0x06, 0x01}, "identity request"},
        {{0x7D, 1, 2, 3}, "private message"},
        {{0x7D, 'J', 'W', 0x11, 1, 2}, "private message"},
        {{0x7E, 0x7F, 0x08, 0x02, 0, 5, 1}, "MIDI tuning, notes"},  // cut
        {{0x7F, 0x7F, 0x90}, "message with bytes above 0x7F"},
        {{}, "empty message"}};
    for (const auto& [bytes, name] : kinds) {
        const DecodedExclusive decoded = decode_exclusive(bytes);
        EXPECT_TRUE(decoded.messages.empty()) << name;
        EXPECT_EQ(decoded.name, name);
    }
}

TEST(SystemMessages, PartsOfGsAndXgAreSetAsByControllers) {
    using Bytes = std::vector<std::uint8_t>;
    const auto text = [](const Bytes& bytes) {
        std::string all;
        for (const ChannelMessage& message : decode_exclusive(bytes).messages)
            all += std::to_string(message.status) + " " + std::to_string(message.data1) + " " +
                   std::to_string(message.data2) + ";";
        return all;
    };
    const auto gs = [&](std::uint8_t part, std::uint8_t address, Bytes data) {
        Bytes bytes{0x41, 0x10, 0x42, 0x12, 0x40, part, address};
        bytes.insert(bytes.end(), data.begin(), data.end());
        bytes.push_back(0);  // checksum
        return text(bytes);
    };
    EXPECT_EQ(gs(0x11, 0x00, {8, 24}), "176 0 8;192 24 0;");  // part 1 is channel 1
    EXPECT_EQ(gs(0x10, 0x00, {0, 16}), "185 0 0;201 16 0;");  // block 0 is channel 10
    EXPECT_EQ(gs(0x1A, 0x19, {50}), "186 7 50;");             // block A is channel 11
    EXPECT_EQ(gs(0x12, 0x1C, {127}), "177 10 127;");
    EXPECT_EQ(gs(0x12, 0x1C, {0}), "");  // random
    const auto xg = [&](std::uint8_t address, std::uint8_t value) {
        return text({0x43, 0x10, 0x4C, 0x08, 0x03, address, value});
    };
    EXPECT_EQ(xg(0x01, 127), "179 0 127;");
    EXPECT_EQ(xg(0x02, 3), "179 32 3;");
    EXPECT_EQ(xg(0x03, 24), "195 24 0;");
    EXPECT_EQ(xg(0x0B, 50), "179 7 50;");
    EXPECT_EQ(xg(0x0E, 1), "179 10 1;");
    EXPECT_EQ(xg(0x0E, 0), "");
}

TEST(SystemMessages, PrivateFormComesBack) {
    for (std::uint8_t status = first_system_kind; status <= last_system_kind; ++status) {
        const ChannelMessage message{status, 5, 127};
        const auto decoded = decode_exclusive(private_exclusive(message));
        ASSERT_EQ(decoded.messages.size(), 1U);
        EXPECT_EQ(decoded.messages[0].status, status);
        EXPECT_EQ(decoded.messages[0].data1, 5);
        EXPECT_EQ(decoded.messages[0].data2, 127);
    }
}

}  // namespace
}  // namespace jawari::host
