// Arbitrary bytes as an OSC packet: refused with a line, or messages that a command can be made of.
#include <cstdint>
#include <span>
#include <string>

#include "check.h"
#include "commands/play/osc_message.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace jawari;
    const auto messages = host::decode_osc(std::span(reinterpret_cast<const char*>(data), size));
    if (!messages) {
        fuzz::require(!messages.error().message.empty(), "a reason");
        return 0;
    }
    fuzz::require(messages.value().size() <= host::most_osc_messages, "a bounded number of messages");
    for (const host::OscMessage& message : messages.value()) {
        fuzz::require(message.path.starts_with('/'), "an address");
        const std::string verb = message.path.substr(message.path.rfind('/') + 1);
        (void)host::make_call(verb, message.arguments);
        const auto again = host::encode_osc(message);
        fuzz::require(again.size() % 4 == 0, "a packet of whole words");
    }
    return 0;
}
