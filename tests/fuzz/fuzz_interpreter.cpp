// Arbitrary bytes as they might come over a wire: every event is in its range, and nothing is dropped.
#include <cmath>
#include <cstdint>

#include "check.h"
#include "midi/byte_stream.h"
#include "midi/interpreter.h"

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
    for (std::size_t i = 0; i < size; ++i) {
        const auto message = host::take_byte(stream, data[i]);
        if (!message) continue;
        host::interpret(interpreter, *message, actions);
        fuzz::require(actions.count < actions.events.size(), "events fit");
        for (std::size_t e = 0; e < actions.count; ++e) check_event(actions.events[e]);
    }
    return 0;
}
