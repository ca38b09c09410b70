// One MIDI input: the port of a keyboard, or a port of our own that other programs connect to.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "devices/held_notes.h"
#include "midi/system_message.h"
#include "player/midi_port.h"

class RtMidiIn;

namespace jawari::host {

/// Of the ports that connections end at; JACK adds a number to all but the first.
inline constexpr const char* midi_client_name = "jawari-midi";

/// In the order in which `auto` tries them: those that the library here was built with.
std::vector<std::string> midi_systems();

/// Every word that --midi takes, whether the library here has it or not.
const std::vector<std::string>& midi_system_words();

/// A whole message as drivers hand it over; nothing for system messages and for what is no message.
std::optional<ChannelMessage> channel_message(std::span<const unsigned char> bytes);

/// Whole system messages: system exclusive ones, System Reset (FF). Nothing for others.
std::optional<DecodedExclusive> system_messages(std::span<const unsigned char> bytes);

/// A sender that has sent active sensing (FE) and then nothing for this long is gone (MIDI 1.0: 300 ms).
inline constexpr std::int64_t sensing_limit_ns = 330'000'000;

/// Looks at the inputs of a system. It stays connected, so that looking again costs little.
class MidiLister {
  public:
    static Outcome<std::unique_ptr<MidiLister>> create(const std::string& system);
    MidiLister(const MidiLister&) = delete;
    MidiLister& operator=(const MidiLister&) = delete;
    ~MidiLister();

    /// Names of inputs, without our own.
    std::vector<std::string> names();

  private:
    MidiLister();
    std::unique_ptr<RtMidiIn> midi_;
};

class MidiReceiver {
  public:
    /// Connects to the input `index` of names(), whose name is `name`. `port` takes what comes, with its
    /// time, and outlives the receiver.
    static Outcome<std::unique_ptr<MidiReceiver>> connect(const std::string& system, std::size_t index,
                                                          const std::string& name, MidiPort& port);
    /// A port of our own.
    static Outcome<std::unique_ptr<MidiReceiver>> make_virtual(const std::string& system, MidiPort& port);

    MidiReceiver(const MidiReceiver&) = delete;
    MidiReceiver& operator=(const MidiReceiver&) = delete;
    /// Ends its thread, then lets go of what it held.
    ~MidiReceiver();

    /// Lets go of what is held if active sensing has stopped; true when it does. Control thread.
    bool release_if_silent(std::int64_t now_ns);

    /// Lets go of what is held. Control thread.
    void release();

    /// System exclusive messages that came and mean nothing here, by name. Control thread.
    [[nodiscard]] std::map<std::string, std::uint64_t> ignored_exclusives();

    [[nodiscard]] const std::string& name() const { return name_; }
    /// What the system calls our end of the connection; empty where nobody needs to know. Control thread.
    [[nodiscard]] const std::string& own_port() const { return own_port_; }
    void set_own_port(std::string own_port) { own_port_ = std::move(own_port); }
    [[nodiscard]] MidiPort& port() const { return *port_; }

  private:
    MidiReceiver(std::string name, MidiPort& port);
    static Outcome<std::unique_ptr<MidiReceiver>> create(const std::string& system, const std::string& name,
                                                         MidiPort& port);
    void take_system(std::span<const unsigned char> bytes, std::int64_t now_ns);
    static void receive(double delta_s, std::vector<unsigned char>* bytes, void* user);

    std::string name_, own_port_;
    MidiPort* port_;
    std::mutex mutex_;  ///< of held_, ignored_ and port_, which the receiving and the control thread use
    HeldNotes held_;
    std::map<std::string, std::uint64_t> ignored_;
    std::int64_t latest_ns_ = 0;  ///< when the latest message came
    bool sensing_ = false;        ///< active sensing has come
    std::unique_ptr<RtMidiIn> midi_;
};

}  // namespace jawari::host
