// Every MIDI input that the player asked for: connected when it is there, let go when it is gone, connected
// again when it comes back.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "devices/connection_watch.h"
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

    /// Lets go of what senders hold whose active sensing has stopped or whose connection was cut; to be
    /// called every few milliseconds.
    void watch(std::int64_t now_ns);

    /// After the server of the system was lost: everything anew, without an error.
    void restart();

    /// Ends all receivers.
    void stop();

    /// System exclusive messages that came and mean nothing here, by name.
    [[nodiscard]] std::map<std::string, std::uint64_t> ignored_exclusives() const;

    [[nodiscard]] const std::string& system() const { return system_; }
    [[nodiscard]] std::size_t connected() const { return receivers_.size(); }

  private:
    MaybeError choose_system();
    [[nodiscard]] std::vector<std::size_t> wanted(const std::vector<std::string>& names) const;
    [[nodiscard]] bool wants_virtual() const;
    void drop_vanished(const std::vector<std::string>& names);
    void connect_new(const std::vector<std::string>& names);
    void connect_virtual();
    void watch_connections();
    /// A receiver that was just made: by what name its port is heard of.
    void name_own_port(MidiReceiver& receiver);
    [[nodiscard]] MidiReceiver* receiver_of(const std::string& own_port) const;
    void keep_ignored(MidiReceiver& receiver);
    MidiPort* take_port();

    MidiWish wish_;
    PortMaker make_port_;
    Report report_;
    std::string system_;
    std::string input_;  ///< the named input that was found at the start, for when it comes back
    std::unique_ptr<MidiLister> lister_;
    std::unique_ptr<ConnectionWatch> connections_;  ///< null where nobody tells
    std::vector<std::unique_ptr<MidiReceiver>> receivers_;
    std::unique_ptr<MidiReceiver> virtual_;
    std::vector<MidiPort*> spare_ports_;
    std::map<std::string, std::uint64_t> ignored_;  ///< of receivers that are gone
    std::vector<std::string> refused_;              ///< reported once
};

}  // namespace jawari::host
