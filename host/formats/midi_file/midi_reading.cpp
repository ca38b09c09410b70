#include "formats/midi_file/midi_reading.h"

#include <algorithm>
#include <utility>

namespace jawari::host {

namespace {

constexpr std::size_t most_ports = 128;  // as FF 21 numbers them

}  // namespace

bool MidiNotes::repair(std::size_t offset, int track, int kind, const std::string& value,
                       const std::string& allowed, const std::string& assumed) {
    Failure failure = midi_failure(offset, track, value, allowed);
    if (strict()) {
        failure_ = std::move(failure);
        return false;
    }
    const auto [place, is_new] = index_.try_emplace({track, kind}, repairs_.size());
    if (is_new) {
        repairs_.push_back({failure.place, value, assumed, 1});
    } else {
        repairs_[place->second].count += 1;
    }
    return true;
}

std::string text_of(const MidiRepair& repair) {
    const std::string times = repair.count > 1 ? ", " + std::to_string(repair.count) + " times" : "";
    return repair.place + ": " + repair.what + times + "; " + repair.assumed;
}

std::uint8_t MidiNotes::port_of_device(const std::string& name) {
    const auto next = static_cast<std::uint8_t>(std::min(devices_.size(), most_ports - 1));
    return devices_.try_emplace(name, next).first->second;
}

Failure midi_failure(std::size_t offset, int track, std::string value, std::string allowed) {
    std::string place = "byte " + std::to_string(offset);
    if (track >= 0) place += " (track " + std::to_string(track + 1) + ")";
    return {std::move(place), std::move(value), std::move(allowed)};
}

}  // namespace jawari::host
