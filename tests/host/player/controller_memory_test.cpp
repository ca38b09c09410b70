#include "player/controller_memory.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include "midi/interpreter.h"

namespace jawari::host {
namespace {

/// What the interpreter knows, byte for byte but for a data entry under way.
struct Known {
    double bend_range, fine_tuning, timbre, pressure;
    int bend;
    bool operator==(const Known&) const = default;
};

std::vector<Known> known(const MidiInterpreter& interpreter) {
    std::vector<Known> all;
    for (const MidiChannel& channel : interpreter.channels)
        all.push_back({channel.bend_range_semitones, channel.fine_tuning_semitones, channel.timbre,
                       channel.pressure, channel.bend});
    return all;
}

/// Last value of every parameter, pedal and bend that the messages set, as the engine would have it.
struct Applied {
    std::array<std::array<double, parameter_count>, 16> parameters{};
    std::array<double, 16> sustain{}, soft{}, bend{}, pressure{};
    bool operator==(const Applied&) const = default;
};

void apply(const MidiActions& actions, Applied& applied) {
    for (std::size_t i = 0; i < actions.count; ++i) {
        const InstrumentEvent& event = actions.events[i];
        const auto channel = static_cast<std::size_t>(event.channel);
        switch (event.type) {
            case InstrumentEventType::SetParameter:
                applied.parameters[channel][static_cast<std::size_t>(event.parameter)] = event.value;
                break;
            case InstrumentEventType::Sustain:
                applied.sustain[channel] = event.value;
                break;
            case InstrumentEventType::SoftPedal:
                applied.soft[channel] = event.value;
                break;
            case InstrumentEventType::Bend:
                applied.bend[channel] = event.value;
                break;
            case InstrumentEventType::Pressure:
                applied.pressure[channel] = event.value;
                break;
            case InstrumentEventType::ResetControllers:
                applied.sustain[channel] = applied.soft[channel] = applied.bend[channel] =
                    applied.pressure[channel] = 0;
                break;
            default:
                break;
        }
    }
}

/// A fresh interpreter that is told what is remembered knows what the one knows that heard everything.
TEST(ControllerMemory, RecallsWhatRandomControllersHaveSet) {
    for (unsigned seed = 1; seed <= 30; ++seed) {
        std::mt19937 random(seed);
        const auto below = [&](unsigned n) { return static_cast<std::uint8_t>(random() % n); };
        ControllerMemory memory = make_controller_memory();
        MidiInterpreter heard = make_interpreter({});
        MidiActions actions;
        Applied by_hearing, by_recall;
        const auto send = [&](const ChannelMessage& message) {
            interpret(heard, message, actions);
            apply(actions, by_hearing);
            remember(memory, message);
        };
        for (int n = 0; n < 400; ++n) {
            const std::uint8_t channel = below(3);
            const auto status = static_cast<std::uint8_t>(0xB0 + channel);
            switch (below(5)) {
                case 0:
                    send({static_cast<std::uint8_t>(0xE0 + channel), below(128), below(128)});
                    break;
                case 1:
                    send({static_cast<std::uint8_t>(0xD0 + channel), below(128), 0});
                    break;
                case 2:  // RPN 0 to 1
                    send({status, 101, 0});
                    send({status, 100, below(2)});
                    send({status, 6, below(49)});
                    break;
                default: {
                    constexpr std::array<std::uint8_t, 8> controllers{1, 7, 10, 11, 64, 67, 68, 74};
                    send({status, controllers[below(8)], below(128)});
                    break;
                }
            }
            if (n % 97 == 50) send({status, 121, 0});
        }
        MidiInterpreter told = make_interpreter({});
        std::size_t messages = 0;
        recall(memory, [&](const ChannelMessage& message) {
            ++messages;
            interpret(told, message, actions);
            apply(actions, by_recall);
        });
        EXPECT_LE(messages, most_recalled_messages);
        EXPECT_EQ(known(told), known(heard)) << seed;
        EXPECT_EQ(by_recall.sustain, by_hearing.sustain) << seed;
        EXPECT_EQ(by_recall.soft, by_hearing.soft) << seed;
        EXPECT_EQ(by_recall.bend, by_hearing.bend) << seed;
        EXPECT_EQ(by_recall.pressure, by_hearing.pressure) << seed;
        for (const ParameterId id : {ParameterId::Volume, ParameterId::Pan, ParameterId::Legato}) {
            for (std::size_t channel = 0; channel < 3; ++channel)
                EXPECT_EQ(by_recall.parameters[channel][static_cast<std::size_t>(id)],
                          by_hearing.parameters[channel][static_cast<std::size_t>(id)])
                    << seed;
        }
    }
}

TEST(ControllerMemory, KeepsMpeZones) {
    ControllerMemory memory = make_controller_memory();
    MidiInterpreter told = make_interpreter({});
    MidiActions actions;
    for (const ChannelMessage& message : {ChannelMessage{0xB0, 101, 0}, ChannelMessage{0xB0, 100, 6},
                                          ChannelMessage{0xB0, 6, 5}, ChannelMessage{0xB2, 74, 100}})
        remember(memory, message);
    recall(memory, [&](const ChannelMessage& message) { interpret(told, message, actions); });
    EXPECT_EQ(told.zones.lower_members, 5);
    EXPECT_GT(told.channels[2].timbre, 0.7);
}

}  // namespace
}  // namespace jawari::host
