#include "commands/play/osc_message.h"

#include <lo/lo_lowlevel.h>
#include <lo/lo_types.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

namespace jawari::host {

namespace {

constexpr std::string_view bundle_mark("#bundle\0", 8);
constexpr std::size_t time_tag_bytes = 8;
constexpr std::size_t size_bytes = 4;
constexpr int deepest_bundle = 4;

/// lo_message is a pointer to void in liblo 0.31, to an opaque struct in 0.32.
struct FreeMessage {
    void operator()(lo_message message) const { lo_message_free(message); }
};
using Message = std::unique_ptr<std::remove_pointer_t<lo_message>, FreeMessage>;

Error malformed(const std::string& what) {
    return {ErrorKind::Usage, "OSC: " + what};
}

/// liblo leaves arguments where they lie in the packet, eight-byte numbers too, at any multiple of four.
template <class T>
T number_at(const void* argument) {
    T value{};
    std::memcpy(&value, argument, sizeof value);
    return value;
}

std::optional<VerbValue> value_of(lo_type type, const void* argument) {
    switch (type) {
        case LO_INT32:
            return static_cast<double>(number_at<std::int32_t>(argument));
        case LO_INT64:
            return static_cast<double>(number_at<std::int64_t>(argument));
        case LO_FLOAT:
            return static_cast<double>(number_at<float>(argument));
        case LO_DOUBLE:
            return number_at<double>(argument);
        case LO_STRING:
        case LO_SYMBOL:
            return std::string(static_cast<const char*>(argument));
        case LO_TRUE:
            return 1.0;
        case LO_FALSE:
            return 0.0;
        default:
            return std::nullopt;
    }
}

/// Paths and strings end with a zero inside the packet; liblo checks that for all but the path.
std::optional<std::string> path_of(std::span<const char> packet) {
    const std::string_view text(packet.data(), packet.size());
    const std::size_t end = text.find('\0');
    if (end == std::string_view::npos || !text.starts_with('/')) return std::nullopt;
    return std::string(text.substr(0, end));
}

MaybeError decode_message(std::span<const char> packet, std::vector<OscMessage>& messages) {
    if (messages.size() == most_osc_messages) return malformed("too many messages in a packet");
    auto path = path_of(packet);
    if (!path) return malformed("no address that starts with /");
    int status = 0;
    std::vector<char> copy(packet.begin(), packet.end());  // liblo takes it without const
    const Message message(lo_message_deserialise(copy.data(), copy.size(), &status));
    if (!message) return malformed("not a message");
    OscMessage result{std::move(*path), {}};
    const char* types = lo_message_get_types(message.get());
    lo_arg** arguments = lo_message_get_argv(message.get());
    const int count = lo_message_get_argc(message.get());
    for (int i = 0; i < count; ++i) {
        auto value = value_of(static_cast<lo_type>(types[i]), arguments[i]);
        if (!value) return malformed(std::string("arguments of the type ") + types[i] + " mean nothing here");
        result.arguments.push_back(std::move(*value));
    }
    messages.push_back(std::move(result));
    return std::nullopt;
}

std::uint32_t big_endian(const char* bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size_bytes; ++i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
    return value;
}

// NOLINTNEXTLINE(misc-no-recursion): bundles hold bundles, deepest_bundle deep at most
MaybeError decode(std::span<const char> packet, int depth, std::vector<OscMessage>& messages) {
    if (!std::string_view(packet.data(), packet.size()).starts_with(bundle_mark))
        return decode_message(packet, messages);
    if (depth == deepest_bundle) return malformed("bundles too deep");
    if (packet.size() < bundle_mark.size() + time_tag_bytes) return malformed("a bundle without its time");
    packet = packet.subspan(bundle_mark.size() + time_tag_bytes);
    while (!packet.empty()) {
        if (packet.size() < size_bytes) return malformed("a bundle that is cut off");
        const std::size_t size = big_endian(packet.data());
        packet = packet.subspan(size_bytes);
        if (size == 0 || size % 4 != 0 || size > packet.size()) return malformed("a wrong size in a bundle");
        if (auto error = decode(packet.first(size), depth + 1, messages)) return error;
        packet = packet.subspan(size);
    }
    return std::nullopt;
}

}  // namespace

Outcome<std::vector<OscMessage>> decode_osc(std::span<const char> packet) {
    if (packet.empty() || packet.size() > longest_osc_packet || packet.size() % 4 != 0)
        return malformed("packets have 4 to " + std::to_string(longest_osc_packet) +
                         " bytes, a multiple of 4");
    std::vector<OscMessage> messages;
    if (auto error = decode(packet, 0, messages)) return *error;
    return messages;
}

std::vector<char> encode_osc(const OscMessage& message) {
    const Message out(lo_message_new());
    for (const VerbValue& value : message.arguments) {
        if (const auto* text = std::get_if<std::string>(&value))
            lo_message_add_string(out.get(), text->c_str());
        else
            lo_message_add_float(out.get(), static_cast<float>(std::get<double>(value)));
    }
    std::size_t size = 0;
    const std::unique_ptr<void, decltype(&std::free)> bytes(
        lo_message_serialise(out.get(), message.path.c_str(), nullptr, &size), &std::free);
    if (!bytes) return {};
    const auto* first = static_cast<const char*>(bytes.get());
    return {first, first + size};
}

}  // namespace jawari::host
