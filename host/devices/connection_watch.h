// Connections of our MIDI inputs that other programs cut while both ports stay. RtMidi does not hand such
// news on; JACK tells every client that asks.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace jawari::host {

struct CutConnection {
    std::string input;   ///< our port, as the system names it
    std::string sender;  ///< the port it was connected to; empty if that is gone already
};

class ConnectionWatch {
  public:
    /// `name`: how the names of our inputs begin. Null where nobody tells: systems other than JACK, no
    /// server, or built without JACK.
    static std::unique_ptr<ConnectionWatch> create(const std::string& system, const std::string& name);

    ConnectionWatch(const ConnectionWatch&) = delete;
    ConnectionWatch& operator=(const ConnectionWatch&) = delete;
    ~ConnectionWatch();

    /// Before an input is made: which ones of that name are there, also those of another such program.
    void note_inputs();
    /// After it was made: its name; nothing if there is no new one, or there are several.
    [[nodiscard]] std::optional<std::string> new_input() const;

    /// What was cut since this was last asked, in order.
    std::vector<CutConnection> take_cuts();

  private:
    struct Client;
    explicit ConnectionWatch(std::unique_ptr<Client> client);

    std::unique_ptr<Client> client_;
};

}  // namespace jawari::host
