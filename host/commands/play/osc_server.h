// Commands as OSC messages over UDP: /jawari/VERB with the verb's arguments. Polled by the control thread, so
// that every command is executed there, one after the other.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "commands/play/verbs.h"

namespace jawari::host {

/// What executing a command comes to.
struct VerbReply {
    std::vector<std::string> lines;                      ///< for people
    std::vector<std::pair<std::string, double>> values;  ///< for programs
    double pause_s = 0;                                  ///< before the next command is read
};

class OscServer {
  public:
    using Execute = std::function<Outcome<VerbReply>(const VerbCall& call)>;

    /// `host`: an IPv4 address of this machine, 0.0.0.0 for all of them. Kind Device if the port is
    /// taken.
    static Outcome<OscServer> open(const std::string& host, std::uint16_t port);

    OscServer(OscServer&& other) noexcept : socket_(std::exchange(other.socket_, -1)), local_(other.local_) {}
    OscServer& operator=(OscServer&&) = delete;
    OscServer(const OscServer&) = delete;
    OscServer& operator=(const OscServer&) = delete;
    ~OscServer();

    /// For platform::wait_for_input().
    [[nodiscard]] int descriptor() const { return socket_; }

    /// Executes what has come, a bounded number of packets. Answers go to the sender: `/jawari/reply` with
    /// the verb and a line each, `/jawari/value` with verb, name and number, `/jawari/error` with the verb
    /// and the reason.
    void take_packets(const Execute& execute);

  private:
    OscServer(int socket, bool local) : socket_(socket), local_(local) {}
    [[nodiscard]] Outcome<VerbCall> call_of(const std::string& verb,
                                            const std::vector<VerbValue>& arguments) const;

    int socket_ = -1;
    bool local_ = true;  ///< nobody but this machine can send
};

}  // namespace jawari::host
