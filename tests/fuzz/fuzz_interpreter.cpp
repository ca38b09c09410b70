// Arbitrary bytes as they might come over a wire: every event is in its range, and nothing is dropped.
#include <cmath>
#include <cstdint>
#include <vector>

#include "check.h"
#include "midi/byte_stream.h"
#include "midi/interpreter.h"
#include "midi/system_message.h"

namespace {

using namespace jawari;
using Type = InstrumentEventType;

void check_event(const InstrumentEvent& event) {
    fuzz::require(event.channel >= 0 && event.channel < 16, "channel");
    fuzz::require(event.key >= -1 && event.key < 128, "key");
    fuzz::require(std::isfinite(event.value), "value is finite");
    if (event.type == Type::Bend) {
        fuzz::require(std::abs(event.value) <= 96, "bend");
    } else if (event.type == Type::SetParameter) {
        const ParameterDeclaration& parameter = declaration_of(event.parameter);
        fuzz::require(event.value >= parameter.low && event.value <= parameter.high, "parameter");
    } else {
        fuzz::require(event.value >= 0 && event.value <= 1, "value");
    }
}

void take(host::MidiInterpreter& interpreter, const host::ChannelMessage& message,
          host::MidiActions& actions) {
    host::interpret(interpreter, message, actions);
    fuzz::require(actions.count < actions.events.size(), "events fit");
    for (std::size_t e = 0; e < actions.count; ++e) check_event(actions.events[e]);
}

/// Bytes between F0 and the next status byte, as a system exclusive message.
class Exclusives {
  public:
    /// Messages that the byte completes.
    std::vector<host::ChannelMessage> add(std::uint8_t byte) {
        if (byte < 0x80) {
            if (open_) bytes_.push_back(byte);
            return {};
        }
        std::vector<host::ChannelMessage> messages;
        if (open_) messages = host::decode_exclusive(bytes_).messages;
        open_ = byte == 0xF0;
        bytes_.clear();
        for (const host::ChannelMessage& message : messages)
            fuzz::require((host::is_system(message) || (message.status >= 0x80 && message.status < 0xF0)) &&
                              message.data1 < 0x80 && message.data2 < 0x80,
                          "a message to the instrument or a channel");
        return messages;
    }

  private:
    bool open_ = false;
    std::vector<std::uint8_t> bytes_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    host::InterpreterSettings settings;
    if (size > 0 && data[0] < 12) {
        settings.guitar_channel = data[0];
        settings.guitar_strings = 4;
    }
    host::MidiInterpreter interpreter = host::make_interpreter(settings);
    host::MidiByteStream stream;
    host::MidiActions actions;
    Exclusives exclusives;
    for (std::size_t i = 0; i < size; ++i) {
        for (const host::ChannelMessage& message : exclusives.add(data[i]))
            take(interpreter, message, actions);
        if (const auto message = host::take_byte(stream, data[i])) take(interpreter, *message, actions);
    }
    return 0;
}
