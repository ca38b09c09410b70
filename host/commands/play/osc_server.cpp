#include "commands/play/osc_server.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <span>

#include "base/platform.h"
#include "base/text.h"
#include "commands/play/osc_message.h"

namespace jawari::host {

namespace {

constexpr std::string_view prefix = "/jawari/";
constexpr int most_packets = 64;  // at a time, so that a flood leaves room for everything else

class Sender {
  public:
    Sender(int socket, const platform::NetworkAddress& address) : socket_(socket), address_(address) {}

    void send(const std::string& path, std::vector<VerbValue> arguments) const {
        const std::vector<char> packet = encode_osc({path, std::move(arguments)});
        // A sender that does not listen is its own affair.
        platform::send_datagram(socket_, packet, address_);
    }

    void reply(const std::string& verb, const Outcome<VerbReply>& outcome) const {
        if (!outcome) {
            send("/jawari/error", {verb, printable(outcome.error().message)});
            return;
        }
        for (const auto& [name, value] : outcome.value().values) send("/jawari/value", {verb, name, value});
        for (const std::string& line : outcome.value().lines) send("/jawari/reply", {verb, line});
        if (outcome.value().lines.empty()) send("/jawari/reply", {verb, std::string("ok")});
    }

  private:
    int socket_;
    platform::NetworkAddress address_;
};

}  // namespace

Outcome<OscServer> OscServer::open(const std::string& host, std::uint16_t port) {
    const auto address = platform::host_address(host);
    if (!address)
        return usage_error("--osc-host", in_quotes(host),
                           "an IPv4 address like 127.0.0.1, or 0.0.0.0 for all");
    const bool local = (*address >> 24U) == 127;
    OscServer server(platform::open_datagram_socket({*address, port}), local);
    if (server.socket_ < 0)
        return Error{ErrorKind::Device,
                     "OSC: " + host + ":" + std::to_string(port) + ": " + std::strerror(errno)};
    return server;
}

OscServer::~OscServer() {
    if (socket_ >= 0) platform::close_socket(socket_);
}

/// From other machines come names, not paths: a recording or preset anywhere on the disk is for its user to
/// name.
Outcome<VerbCall> OscServer::call_of(const std::string& verb, const std::vector<VerbValue>& arguments) const {
    auto call = make_call(verb, arguments);
    if (!call || local_) return call;
    for (const VerbValue& value : call.value().arguments) {
        const auto* text = std::get_if<std::string>(&value);
        if (text != nullptr && text->find('/') != std::string::npos)
            return usage_error(verb, in_quotes(*text), "over the network a name without /");
    }
    return call;
}

void OscServer::take_packets(const Execute& execute) {
    for (int i = 0; i < most_packets; ++i) {
        std::array<char, longest_osc_packet + 1> packet{};
        platform::NetworkAddress address;
        const std::ptrdiff_t size = platform::receive_datagram(socket_, packet, address);
        if (size < 0) return;
        const Sender sender(socket_, address);
        const auto messages = decode_osc(std::span(packet.data(), static_cast<std::size_t>(size)));
        if (!messages) {
            sender.send("/jawari/error", {std::string(), messages.error().message});
            continue;
        }
        for (const OscMessage& message : messages.value()) {
            const bool ours = message.path.starts_with(prefix);
            const std::string verb = ours ? message.path.substr(prefix.size()) : message.path;
            const auto call = call_of(verb, message.arguments);
            sender.reply(verb, call ? execute(call.value()) : Outcome<VerbReply>(call.error()));
        }
    }
}

}  // namespace jawari::host
