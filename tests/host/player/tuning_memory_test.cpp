#include "player/tuning_memory.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "midi/interpreter.h"
#include "player/controller_memory.h"

namespace jawari::host {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// An interpreter that hears everything, beside what is remembered.
struct Pair {
    MidiInterpreter heard = make_interpreter({});
    ControllerMemory memory = make_controller_memory();
    MidiActions actions;

    void send(const ChannelMessage& message) {
        interpret(heard, message, actions);
        remember(memory, message);
    }
    void exclusive(const Bytes& bytes) {
        for (const ChannelMessage& message : decode_exclusive(bytes).messages) send(message);
    }
};

MidiInterpreter told(const ControllerMemory& memory) {
    MidiInterpreter interpreter = make_interpreter({});
    MidiActions actions;
    std::size_t messages = 0;
    recall(memory, [&](const ChannelMessage& message) {
        interpret(interpreter, message, actions);
        ++messages;
    });
    EXPECT_LE(messages, most_recalled_messages);
    return interpreter;
}

TEST(TuningMemory, RecallsWhatRandomMessagesHaveTuned) {
    std::mt19937 random(1);
    const auto below = [&random](unsigned n) { return static_cast<std::uint8_t>(random() % n); };
    Pair pair;
    for (int n = 0; n < 500; ++n) {
        if (below(2) == 0) {  // two notes of one of four programs
            pair.exclusive({0x7F, 0x7F, 0x08, 0x02, below(4), 2, below(128), below(127), below(128),
                            below(128), below(128), below(127), below(128), below(128)});
        } else {  // an octave of two bytes on some channels
            Bytes bytes{0x7E, 0x7F, 0x08, 0x09, below(4), below(128), below(128)};
            for (int i = 0; i < 24; ++i) bytes.push_back(below(128));
            pair.exclusive(bytes);
        }
    }
    const MidiInterpreter again = told(pair.memory);
    EXPECT_EQ(again.tunings.keys, pair.heard.tunings.keys);
    EXPECT_EQ(again.tunings.classes, pair.heard.tunings.classes);
}

TEST(TuningMemory, AProgramThatIsFullIsRecalled) {
    Pair pair;
    Bytes dump{0x7E, 0x7F, 0x08, 0x01, 127};
    dump.resize(dump.size() + 16, 'x');
    for (std::uint8_t key = 0; key < 127; ++key) dump.insert(dump.end(), {key, 64, 5});
    dump.insert(dump.end(), {126, 64, 5, 0});
    pair.exclusive(dump);
    pair.send({0xB3, 101, 0});
    pair.send({0xB3, 100, 3});
    pair.send({0xB3, 6, 127});
    const MidiInterpreter again = told(pair.memory);
    EXPECT_EQ(again.tunings.keys[127][40], pair.heard.tunings.keys[127][40]);
    EXPECT_NEAR(static_cast<double>(again.tunings.keys[127][40]), (64 * 128 + 5) / 16384.0, 1e-6);
    EXPECT_EQ(again.channels[3].tuning_program, 127);
}

TEST(TuningMemory, ResetsOfControllersKeepTuningsAndThoseOfTheInstrumentDoNot) {
    Pair pair;
    pair.exclusive({0x7F, 0x7F, 0x08, 0x02, 0, 1, 60, 60, 64, 0});
    pair.send({0xB0, 121, 0});
    EXPECT_EQ(pair.heard.tunings.keys[0][60], 0.5F);
    EXPECT_EQ(told(pair.memory).tunings.keys[0][60], 0.5F);
    pair.exclusive({0x7E, 0x7F, 0x09, 0x01});
    EXPECT_EQ(pair.heard.tunings.keys[0][60], 0.0F);
    EXPECT_EQ(told(pair.memory).tunings.keys[0][60], 0.0F);
}

}  // namespace
}  // namespace jawari::host
