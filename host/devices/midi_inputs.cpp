#include "devices/midi_inputs.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "base/text.h"
#include "devices/audio_devices.h"

namespace jawari::host {

namespace {

bool contains(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// Loops that ALSA always has, and our own ports: connecting to them plays nothing or everything twice.
bool is_no_keyboard(const std::string& name) {
    const std::string lower = lower_case(name);
    return lower.find("midi through") != std::string::npos || lower.starts_with(midi_client_name);
}

}  // namespace

std::string lasting_name(const std::string& name) {
    const auto digit = [](unsigned char c) { return std::isdigit(c) != 0; };
    std::size_t end = name.size();
    while (end > 0 && digit(static_cast<unsigned char>(name[end - 1]))) --end;
    if (end == name.size() || end == 0 || name[end - 1] != ':') return name;
    std::size_t begin = --end;
    while (begin > 0 && digit(static_cast<unsigned char>(name[begin - 1]))) --begin;
    if (begin == end || begin == 0 || name[begin - 1] != ' ') return name;
    return name.substr(0, begin - 1);
}

MidiInputs::MidiInputs(MidiWish wish, PortMaker make_port, Report report)
    : wish_(std::move(wish)), make_port_(std::move(make_port)), report_(std::move(report)) {}

MaybeError MidiInputs::choose_system() {
    const bool automatic = wish_.system == "auto";
    const std::vector<std::string> systems = midi_systems();
    if (!automatic && !contains(systems, wish_.system))
        return Error{ErrorKind::Device,
                     "midi: " + wish_.system + ": not built in (built in: " + join(systems) + ")"};
    std::vector<std::string> reasons;
    for (const std::string& system : automatic ? systems : std::vector<std::string>{wish_.system}) {
        auto lister = MidiLister::create(system);
        if (lister) {
            system_ = system;
            lister_ = std::move(lister.value());
            return std::nullopt;
        }
        reasons.push_back(system + ": " + lister.error().message);
    }
    return Error{ErrorKind::Device,
                 "midi: " + (reasons.empty() ? "no system is built in" : join(reasons, "; "))};
}

MaybeError MidiInputs::start() {
    if (auto error = choose_system()) return error;
    const std::vector<std::string> names = lister_->names();
    if (wish_.input != automatic_midi_in && wish_.input != virtual_midi_in) {
        const auto index = match_name(names, wish_.input, "MIDI input");
        if (!index) return Error{index.error().kind, "midi: " + system_ + ": " + index.error().message};
        input_ = lasting_name(names[index.value()]);
    }
    connections_ = ConnectionWatch::create(system_, midi_client_name);
    connect_virtual();
    connect_new(names);
    return std::nullopt;
}

bool MidiInputs::wants_virtual() const {
    return wish_.input == automatic_midi_in || wish_.input == virtual_midi_in;
}

std::vector<std::size_t> MidiInputs::wanted(const std::vector<std::string>& names) const {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool named = !input_.empty() && lasting_name(names[i]) == input_;
        const bool automatic = wish_.input == automatic_midi_in && !is_no_keyboard(names[i]);
        if (named || automatic) indices.push_back(i);
    }
    return indices;
}

MidiPort* MidiInputs::take_port() {
    if (spare_ports_.empty()) return make_port_();
    MidiPort* port = spare_ports_.back();
    spare_ports_.pop_back();
    return port;
}

void MidiInputs::connect_virtual() {
    if (!wants_virtual() || virtual_) return;
    MidiPort* port = take_port();
    if (port == nullptr) return;
    if (connections_) connections_->note_inputs();
    auto receiver = MidiReceiver::make_virtual(system_, *port);
    if (receiver) {
        virtual_ = std::move(receiver.value());
        name_own_port(*virtual_);
        report_("midi: " + system_ + ": " + virtual_->name());
    } else {
        spare_ports_.push_back(port);
        report_("midi: " + system_ + ": no virtual port: " + receiver.error().message);
    }
}

void MidiInputs::connect_new(const std::vector<std::string>& names) {
    for (const std::size_t index : wanted(names)) {
        const std::string& name = names[index];
        const auto is_it = [&](const auto& receiver) { return receiver->name() == name; };
        if (std::any_of(receivers_.begin(), receivers_.end(), is_it) || contains(refused_, name)) continue;
        MidiPort* port = take_port();
        if (port == nullptr) {
            refused_.push_back(name);
            report_("warning: midi: " + in_quotes(name) + " is left out: too many inputs");
            continue;
        }
        if (connections_) connections_->note_inputs();
        auto receiver = MidiReceiver::connect(system_, index, name, *port);
        if (receiver) {
            receivers_.push_back(std::move(receiver.value()));
            name_own_port(*receivers_.back());
            report_("midi: " + system_ + ": connected to " + in_quotes(name));
        } else {
            spare_ports_.push_back(port);
            refused_.push_back(name);
            report_("warning: midi: " + in_quotes(name) + ": " + receiver.error().message);
        }
    }
}

void MidiInputs::drop_vanished(const std::vector<std::string>& names) {
    const auto vanished = [&](const auto& receiver) { return !contains(names, receiver->name()); };
    for (auto& receiver : receivers_) {
        if (!vanished(receiver)) continue;
        report_("warning: midi: " + in_quotes(receiver->name()) + " is gone; its notes are released");
        spare_ports_.push_back(&receiver->port());
        keep_ignored(*receiver);
        receiver.reset();
    }
    std::erase(receivers_, nullptr);
    std::erase_if(refused_, [&](const std::string& name) { return !contains(names, name); });
}

void MidiInputs::poll() {
    if (!lister_ || (input_.empty() && wish_.input != automatic_midi_in)) return;
    const std::vector<std::string> names = lister_->names();
    drop_vanished(names);
    connect_new(names);
}

void MidiInputs::watch(std::int64_t now_ns) {
    const auto look = [&](MidiReceiver& receiver) {
        if (receiver.release_if_silent(now_ns))
            report_("warning: midi: " + in_quotes(receiver.name()) +
                    " has stopped its active sensing; its notes are released");
    };
    for (const auto& receiver : receivers_) look(*receiver);
    if (virtual_) look(*virtual_);
    watch_connections();
}

void MidiInputs::keep_ignored(MidiReceiver& receiver) {
    for (const auto& [name, count] : receiver.ignored_exclusives()) ignored_[name] += count;
}

std::map<std::string, std::uint64_t> MidiInputs::ignored_exclusives() const {
    std::map<std::string, std::uint64_t> all = ignored_;
    const auto add = [&all](MidiReceiver& receiver) {
        for (const auto& [name, count] : receiver.ignored_exclusives()) all[name] += count;
    };
    for (const auto& receiver : receivers_) add(*receiver);
    if (virtual_) add(*virtual_);
    return all;
}

void MidiInputs::name_own_port(MidiReceiver& receiver) {
    if (connections_) receiver.set_own_port(connections_->new_input().value_or(""));
}

MidiReceiver* MidiInputs::receiver_of(const std::string& own_port) const {
    const auto is_it = [&](const auto& receiver) { return receiver && receiver->own_port() == own_port; };
    if (is_it(virtual_)) return virtual_.get();
    const auto found = std::find_if(receivers_.begin(), receivers_.end(), is_it);
    return found == receivers_.end() ? nullptr : found->get();
}

void MidiInputs::watch_connections() {
    if (!connections_) return;
    for (const CutConnection& cut : connections_->take_cuts()) {
        MidiReceiver* receiver = receiver_of(cut.input);
        if (receiver == nullptr) continue;  // of other programs
        if (receiver != virtual_.get()) {
            poll();  // a sender that is gone altogether is dropped, and that is said
            receiver = receiver_of(cut.input);
            if (receiver == nullptr) continue;
        }
        receiver->release();
        const std::string sender = cut.sender.empty() ? "a program that is gone" : in_quotes(cut.sender);
        report_("warning: midi: the connection of " + sender + " to " + cut.input +
                " was cut; its notes are released");
    }
}

void MidiInputs::restart() {
    stop();
    auto lister = MidiLister::create(system_);
    if (!lister) return;
    lister_ = std::move(lister.value());
    connections_ = ConnectionWatch::create(system_, midi_client_name);
    connect_virtual();
    connect_new(lister_->names());
}

void MidiInputs::stop() {
    const auto leave = [this](MidiReceiver& receiver) {
        spare_ports_.push_back(&receiver.port());
        keep_ignored(receiver);
    };
    for (const auto& receiver : receivers_) leave(*receiver);
    receivers_.clear();
    if (virtual_) leave(*virtual_);
    virtual_.reset();
    connections_.reset();
    lister_.reset();
    refused_.clear();
}

}  // namespace jawari::host
