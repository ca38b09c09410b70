#include "formats/tuning/tuning.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/input_file.h"
#include "base/text.h"
#include "formats/tuning/tun_file.h"

namespace jawari::host {

namespace {

double equal_temperament_hz(int key) {
    return 440 * std::exp2((key - 69) / 12.0);
}

/// Above degree 0 on the middle key; nothing if the key is silent.
std::optional<double> key_cents(const Scale& scale, const KeyboardMap& map, int key) {
    const int distance = key - map.middle_key;
    if (map.degrees.empty()) return degree_cents(scale, distance);
    const int size = static_cast<int>(map.degrees.size());
    const int index = (distance % size + size) % size;
    const auto degree = map.degrees[static_cast<std::size_t>(index)];
    if (!degree) return std::nullopt;
    const int repetition = (distance - index) / size;
    const auto octave_degree =
        map.formal_octave == 0 ? static_cast<long long>(scale.cents.size()) : map.formal_octave;
    return repetition * degree_cents(scale, octave_degree) + degree_cents(scale, *degree);
}

bool is_tun(const std::string& path) {
    return lower_case(path).ends_with(".tun");
}

template <class T>
Outcome<T> parsed(const NamedText& file, Result<T> (*parse)(std::string_view)) {
    auto result = parse(file.text);
    if (!result) return invalid_input(file.name, result.failure());
    return std::move(result.value());
}

Outcome<NamedText> load(const std::string& path) {
    auto text = read_file(path, longest_scala_file_bytes);
    if (!text) return text.error();
    return NamedText{path, std::move(text.value())};
}

/// Where a scale lies without a keyboard map.
Result<KeyFrequencies> parse_scale_alone(std::string_view text) {
    const auto scale = parse_scale(text);
    if (!scale) return scale.failure();
    const auto lines = parse_ableton_lines(text, scale.value());
    if (!lines) return lines.failure();
    return tune(scale.value(), lines.value());
}

}  // namespace

Result<KeyFrequencies> tune(const Scale& scale, const KeyboardMap& map) {
    const auto reference = key_cents(scale, map, map.reference_key);
    if (!reference)
        return Failure{
            "reference key", std::to_string(map.reference_key) + ", which the map leaves silent",
            "a key that the map gives a degree; name one, with its own frequency, in the map's fifth "
            "and sixth line"};
    KeyFrequencies frequencies{};
    for (int key = 0; key < static_cast<int>(midi_keys); ++key) {
        double& frequency = frequencies[static_cast<std::size_t>(key)];
        if (key < map.first_key || key > map.last_key) {
            frequency = equal_temperament_hz(key);
            continue;
        }
        frequency = std::numeric_limits<double>::quiet_NaN();
        const auto cents = key_cents(scale, map, key);
        if (!cents) continue;
        const double tuned = map.reference_hz * std::exp2((*cents - *reference) / cents_per_octave);
        if (tuned >= lowest_key_hz && tuned <= highest_key_hz) frequency = tuned;
    }
    return frequencies;
}

Result<KeyFrequencies> tune(const Scale& scale, const AbletonLines& lines) {
    const KeyboardMap map = ableton_map(scale, lines);
    auto tuned = tune(scale, map);
    if (!tuned) return tuned.failure();
    for (std::size_t key = 0; key < midi_keys; ++key) {
        double& hz = tuned.value()[key];
        const auto note = static_cast<long long>(key) - map.middle_key;
        const bool below = hz < lines.lowest_hz || (lines.lowest_note && note < *lines.lowest_note);
        const bool above = hz > lines.highest_hz || (lines.highest_note && note > *lines.highest_note);
        if (below || above) hz = std::numeric_limits<double>::quiet_NaN();
    }
    return tuned;
}

Outcome<KeyFrequencies> read_tuning(const NamedText& scale, const std::optional<NamedText>& keyboard_map) {
    if (!keyboard_map) return parsed(scale, is_tun(scale.name) ? parse_tun : parse_scale_alone);
    if (is_tun(scale.name))
        return usage_error("--keyboard-map", keyboard_map->name,
                           "none with a .tun file, which has the pitch of each key");
    const auto notes = parsed(scale, parse_scale);
    if (!notes) return notes.error();
    const auto map = parsed(*keyboard_map, parse_keyboard_map);
    if (!map) return map.error();
    auto frequencies = tune(notes.value(), map.value());
    if (!frequencies) return invalid_input(keyboard_map->name, frequencies.failure());
    return frequencies.value();
}

Outcome<KeyFrequencies> load_tuning(const std::string& scale, const std::string& keyboard_map) {
    const auto pitches = load(scale);
    if (!pitches) return pitches.error();
    if (keyboard_map.empty()) return read_tuning(pitches.value(), std::nullopt);
    const auto map = load(keyboard_map);
    if (!map) return map.error();
    return read_tuning(pitches.value(), map.value());
}

}  // namespace jawari::host
