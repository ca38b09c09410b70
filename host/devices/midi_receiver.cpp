#include "devices/midi_receiver.h"

#include <RtMidi.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <utility>

#include "devices/quiet.h"
#include "midi/system_message.h"
#include "player/settings.h"

namespace jawari::host {

namespace {

/// Has no ports; named apart so that the ports' client has its name without a number.
constexpr const char* lister_name = "jawari-list";
constexpr const char* virtual_port_name = "in";

Error midi_error(const std::string& reason) {
    const std::size_t place = reason.rfind(": ");
    return {ErrorKind::Device, place == std::string::npos ? reason : reason.substr(place + 2)};
}

/// Keeps the library from writing to standard error by itself.
void ignore_errors(RtMidiError::Type /*type*/, const std::string& /*text*/, void* /*user*/) {}

std::unique_ptr<RtMidiIn> make_client(const std::string& system, const char* name) {
    auto midi = std::make_unique<RtMidiIn>(RtMidi::getCompiledApiByName(system), name);
    midi->setErrorCallback(&ignore_errors);
    midi->ignoreTypes(false, true, false);  // clocks and time code do nothing here
    return midi;
}

/// JACK without a server is no error to the library: it makes a client that has nothing, and prints so.
bool has_server(const QuietStandardError& quiet) {
    return !quiet.mentions("server not running");
}

}  // namespace

const std::vector<std::string>& midi_system_words() {
    // Keyboards are ALSA's on Linux, also where sound goes through JACK.
    static const std::vector<std::string> all{"alsa", "jack", "core", "winmm"};
    return all;
}

std::vector<std::string> midi_systems() {
    std::vector<RtMidi::Api> compiled;
    RtMidi::getCompiledApi(compiled);
    std::vector<std::string> systems;
    for (const std::string& word : midi_system_words()) {
        const auto has = [&](RtMidi::Api api) { return RtMidi::getApiName(api) == word; };
        if (std::any_of(compiled.begin(), compiled.end(), has)) systems.push_back(word);
    }
    return systems;
}

std::optional<ChannelMessage> channel_message(std::span<const unsigned char> bytes) {
    if (bytes.empty() || bytes[0] < 0x80 || bytes[0] >= 0xF0) return std::nullopt;
    const auto count = static_cast<std::size_t>(data_bytes(bytes[0]));
    if (bytes.size() != count + 1) return std::nullopt;
    const auto is_data = [](unsigned char byte) { return byte < 0x80; };
    if (!std::all_of(bytes.begin() + 1, bytes.end(), is_data)) return std::nullopt;
    return ChannelMessage{bytes[0], bytes[1], count == 2 ? bytes[2] : std::uint8_t{0}};
}

std::optional<DecodedExclusive> system_messages(std::span<const unsigned char> bytes) {
    constexpr unsigned char exclusive = 0xF0, end_of_exclusive = 0xF7, system_reset = 0xFF;
    if (bytes.size() == 1 && bytes[0] == system_reset)
        return DecodedExclusive{
            {{static_cast<std::uint8_t>(SystemKind::Reset), static_cast<std::uint8_t>(SoundMode::Plain), 0}},
            "system reset"};
    if (bytes.size() < 2 || bytes.front() != exclusive || bytes.back() != end_of_exclusive)
        return std::nullopt;
    return decode_exclusive(bytes.subspan(1, bytes.size() - 2));
}

// ------------------------------------------------------------------------------------------------ the list

Outcome<std::unique_ptr<MidiLister>> MidiLister::create(const std::string& system) {
    const QuietStandardError quiet;
    std::unique_ptr<MidiLister> lister(new MidiLister);
    try {
        lister->midi_ = make_client(system, lister_name);
    } catch (const std::exception& problem) {
        return midi_error(problem.what());
    }
    if (!has_server(quiet)) return Error{ErrorKind::Device, "no server"};
    return lister;
}

MidiLister::MidiLister() = default;

MidiLister::~MidiLister() {
    const QuietStandardError quiet;
    midi_.reset();
}

std::vector<std::string> MidiLister::names() {
    std::vector<std::string> names;
    try {
        const unsigned int count = midi_->getPortCount();
        for (unsigned int i = 0; i < count; ++i) names.push_back(midi_->getPortName(i));
    } catch (const std::exception&) {
        names.clear();  // a port went away while it was asked for: the next look is right again
    }
    return names;
}

// ---------------------------------------------------------------------------------------------- the receiver

Outcome<std::unique_ptr<MidiReceiver>> MidiReceiver::create(const std::string& system,
                                                            const std::string& name, MidiPort& port) {
    std::unique_ptr<MidiReceiver> receiver(new MidiReceiver(name, port));
    receiver->midi_ = make_client(system, midi_client_name);
    receiver->midi_->setCallback(&receive, receiver.get());
    return receiver;
}

Outcome<std::unique_ptr<MidiReceiver>> MidiReceiver::connect(const std::string& system, std::size_t index,
                                                             const std::string& name, MidiPort& port) {
    const QuietStandardError quiet;
    try {
        auto receiver = create(system, name, port);
        RtMidiIn& midi = *receiver.value()->midi_;
        // Numbers move when ports come and go.
        if (midi.getPortName(static_cast<unsigned int>(index)) != name)
            return Error{ErrorKind::Device, "it went away"};
        midi.openPort(static_cast<unsigned int>(index), virtual_port_name);
        if (!midi.isPortOpen()) return Error{ErrorKind::Device, "it cannot be connected to"};
        return receiver;
    } catch (const std::exception& problem) {
        return midi_error(problem.what());
    }
}

Outcome<std::unique_ptr<MidiReceiver>> MidiReceiver::make_virtual(const std::string& system, MidiPort& port) {
    const QuietStandardError quiet;
    try {
        auto receiver =
            create(system, std::string("virtual port ") + midi_client_name + ":" + virtual_port_name, port);
        receiver.value()->midi_->openVirtualPort(virtual_port_name);
        if (!has_server(quiet)) return Error{ErrorKind::Device, "no server"};
        return receiver;
    } catch (const std::exception& problem) {
        return midi_error(problem.what());
    }
}

MidiReceiver::MidiReceiver(std::string name, MidiPort& port) : name_(std::move(name)), port_(&port) {}

MidiReceiver::~MidiReceiver() {
    const QuietStandardError quiet;
    midi_.reset();
    for (const ChannelMessage& message : release_all(held_)) port_->push({message, 0});
}

void MidiReceiver::receive(double /*delta_s*/, std::vector<unsigned char>* bytes, void* user) {
    constexpr unsigned char active_sensing = 0xFE;
    auto& receiver = *static_cast<MidiReceiver*>(user);
    const std::int64_t now_ns = steady_clock_ns();
    const std::lock_guard lock(receiver.mutex_);
    receiver.latest_ns_ = now_ns;
    if (bytes->size() == 1 && bytes->front() == active_sensing) receiver.sensing_ = true;
    if (const auto message = channel_message(*bytes)) {
        follow(receiver.held_, *message);
        receiver.port_->push({*message, now_ns});
    }
    receiver.take_system(*bytes, now_ns);
}

/// The caller holds the mutex.
void MidiReceiver::take_system(std::span<const unsigned char> bytes, std::int64_t now_ns) {
    const auto decoded = system_messages(bytes);
    if (!decoded) return;
    if (decoded->messages.empty()) ignored_[decoded->name] += 1;
    for (const ChannelMessage& message : decoded->messages) {
        if (static_cast<SystemKind>(message.status) == SystemKind::Reset) held_ = {};
        port_->push({message, now_ns});
    }
}

std::map<std::string, std::uint64_t> MidiReceiver::ignored_exclusives() {
    const std::lock_guard lock(mutex_);
    return ignored_;
}

void MidiReceiver::release() {
    const std::lock_guard lock(mutex_);
    for (const ChannelMessage& message : release_all(held_)) port_->push({message, 0});
}

bool MidiReceiver::release_if_silent(std::int64_t now_ns) {
    const std::lock_guard lock(mutex_);
    if (!sensing_ || now_ns - latest_ns_ < sensing_limit_ns) return false;
    sensing_ = false;  // until it comes again
    for (const ChannelMessage& message : release_all(held_)) port_->push({message, 0});
    return true;
}

}  // namespace jawari::host
