// Every MIDI input that the player asked for: connected when it is there, let go when it is gone, connected
// again when it comes back.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "devices/midi_receiver.h"

namespace jawari::host {

inline constexpr const char* automatic_midi_in = "auto";
inline constexpr const char* virtual_midi_in = "virtual";

struct MidiWish {
    std::string system = "auto";  ///< a word of midi_system_words(), or auto
    std::string input =
        automatic_midi_in;  ///< auto: all of them and a virtual port; virtual; number or part of a name
};

/// The name without what systems add and change when a device is plugged in again: ALSA's client and port
/// numbers at the end.
std::string lasting_name(const std::string& name);

class MidiInputs {
  public:
    /// Hands out queues of the player; null if there are no more.
    using PortMaker = std::function<MidiPort*()>;
    using Report = std::function<void(const std::string& line)>;

    /// `report` is told what connects and goes, on the control thread.
    MidiInputs(MidiWish wish, PortMaker make_port, Report report);

    /// Chooses the system and connects. An error if a named input is not there, or no system can be used.
    MaybeError start();

    /// Looks for what came and went; to be called about once a second.
    void poll();

    /// Lets go of what senders hold whose active sensing has stopped; to be called every few milliseconds.
    void watch(std::int64_t now_ns);

    /// After the server of the system was lost: everything anew, without an error.
    void restart();

    /// Ends all receivers.
    void stop();

    [[nodiscard]] const std::string& system() const { return system_; }
    [[nodiscard]] std::size_t connected() const { return receivers_.size(); }

  private:
    MaybeError choose_system();
    [[nodiscard]] std::vector<std::size_t> wanted(const std::vector<std::string>& names) const;
    [[nodiscard]] bool wants_virtual() const;
    void drop_vanished(const std::vector<std::string>& names);
    void connect_new(const std::vector<std::string>& names);
    void connect_virtual();
    MidiPort* take_port();

    MidiWish wish_;
    PortMaker make_port_;
    Report report_;
    std::string system_;
    std::string input_;  ///< the named input that was found at the start, for when it comes back
    std::unique_ptr<MidiLister> lister_;
    std::vector<std::unique_ptr<MidiReceiver>> receivers_;
    std::unique_ptr<MidiReceiver> virtual_;
    std::vector<MidiPort*> spare_ports_;
    std::vector<std::string> refused_;  ///< reported once
};

}  // namespace jawari::host
