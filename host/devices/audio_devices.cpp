#include "devices/audio_devices.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>

#include "base/suggestion.h"
#include "base/text.h"
#include "devices/quiet.h"
#include "devices/rtaudio_versions.h"

namespace jawari::host {

namespace {

/// A sound server shares the device and knows its settings, so servers come before bare drivers, the one with
/// the shortest delay first.
const std::vector<std::string>& words() {
    static const std::vector<std::string> all{"jack", "pulse", "alsa", "oss", "core", "asio", "wasapi", "ds"};
    return all;
}

std::optional<std::size_t> whole_number(const std::string& text) {
    std::size_t value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::string numbered(const std::vector<std::string>& names) {
    std::vector<std::string> items;
    for (std::size_t i = 0; i < names.size(); ++i)
        items.push_back(std::to_string(i) + " " + in_quotes(names[i]));
    return items.empty() ? "none is there" : join(items);
}

}  // namespace

const std::vector<std::string>& audio_system_words() {
    return words();
}

std::vector<std::string> audio_systems() {
    std::vector<RtAudio::Api> compiled;
    RtAudio::getCompiledApi(compiled);
    std::vector<std::string> systems;
    for (const std::string& word : words()) {
        const auto has = [&](RtAudio::Api api) { return RtAudio::getApiName(api) == word; };
        if (std::any_of(compiled.begin(), compiled.end(), has)) systems.push_back(word);
    }
    return systems;
}

std::string audio_system_title(const std::string& system) {
    return RtAudio::getApiDisplayName(RtAudio::getCompiledApiByName(system));
}

Outcome<std::vector<AudioDevice>> audio_devices(const std::string& system) {
    const QuietStandardError quiet;
    const auto audio = rtaudio::make(RtAudio::getCompiledApiByName(system));
    if (!audio) return Error{ErrorKind::Device, system + ": cannot be used here"};
    std::vector<AudioDevice> devices;
    for (const rtaudio::Device& each : rtaudio::devices(*audio)) {
        if (each.info.outputChannels < 2) continue;
        devices.push_back({each.id, each.info.name, each.info.outputChannels, each.info.isDefaultOutput,
                           each.info.sampleRates, each.info.preferredSampleRate});
    }
    return devices;
}

Outcome<std::size_t> match_name(const std::vector<std::string>& names, const std::string& wanted,
                                const std::string& what) {
    if (const auto number = whole_number(wanted)) {
        if (*number < names.size()) return *number;
    }
    const std::string lower = lower_case(wanted);
    std::vector<std::size_t> parts;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string name = lower_case(names[i]);
        if (name == lower) return i;
        if (name.find(lower) != std::string::npos) parts.push_back(i);
    }
    if (parts.size() == 1) return parts.front();
    const std::string problem =
        parts.empty() ? "no " + what + " has that number or name" : "more than one " + what;
    const std::string hint = parts.empty() ? did_you_mean(wanted, names) : "";
    return Error{ErrorKind::Device, in_quotes(wanted) + ": " + problem + hint + " (" + numbered(names) + ")"};
}

unsigned int choose_rate(const AudioDevice& device, unsigned int wanted_hz) {
    const std::vector<unsigned int>& rates = device.rates_hz;
    if (rates.empty() || std::find(rates.begin(), rates.end(), wanted_hz) != rates.end()) return wanted_hz;
    if (device.preferred_rate_hz > 0) return device.preferred_rate_hz;
    const auto distance = [&](unsigned int rate) {
        return std::abs(static_cast<long long>(rate) - static_cast<long long>(wanted_hz));
    };
    return *std::min_element(rates.begin(), rates.end(),
                             [&](unsigned int a, unsigned int b) { return distance(a) < distance(b); });
}

}  // namespace jawari::host
