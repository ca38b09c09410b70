// Feeds messages to an interpreter, for tests.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "midi/interpreter.h"

namespace jawari::test {

class Player {
  public:
    explicit Player(const host::InterpreterSettings& settings = {})
        : interpreter(host::make_interpreter(settings)) {}

    /// Events of one message.
    std::vector<InstrumentEvent> send(int status, int data1, int data2 = 0) {
        host::interpret(interpreter,
                        {static_cast<std::uint8_t>(status), static_cast<std::uint8_t>(data1),
                         static_cast<std::uint8_t>(data2)},
                        actions);
        return {actions.events.begin(), actions.events.begin() + static_cast<std::ptrdiff_t>(actions.count)};
    }

    /// Controller change. Channels count from 1, as in the specifications.
    std::vector<InstrumentEvent> control(int channel, int controller, int value) {
        return send(0xB0 + channel - 1, controller, value);
    }

    /// Selects an RPN and sends the coarse data.
    std::vector<InstrumentEvent> rpn(int channel, int number, int value) {
        control(channel, 101, 0);
        control(channel, 100, number);
        return control(channel, 6, value);
    }

    /// 14 bits; 8192 is the centre.
    std::vector<InstrumentEvent> bend(int channel, int value) {
        return send(0xE0 + channel - 1, value % 128, value / 128);
    }

    host::MidiInterpreter interpreter;
    host::MidiActions actions;
};

/// Value of the only event of that type, channel (from 0) and parameter; nothing if there is none or several.
inline std::optional<double> value_of(const std::vector<InstrumentEvent>& events, InstrumentEventType type,
                                      int channel, ParameterId parameter = {}) {
    std::optional<double> found;
    for (const InstrumentEvent& event : events) {
        if (event.type != type || event.channel != channel || event.parameter != parameter) continue;
        if (found) return std::nullopt;
        found = event.value;
    }
    return found;
}

}  // namespace jawari::test
