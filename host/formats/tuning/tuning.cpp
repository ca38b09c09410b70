#include "formats/tuning/tuning.h"

#include <cmath>
#include <limits>
#include <optional>

#include "base/input_file.h"

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

template <class T>
Outcome<T> load(const std::string& path, Result<T> (*parse)(std::string_view)) {
    const auto text = read_file(path, longest_scala_file_bytes);
    if (!text) return text.error();
    auto parsed = parse(text.value());
    if (!parsed) return invalid_input(path, parsed.failure());
    return std::move(parsed.value());
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

Outcome<KeyFrequencies> load_tuning(const std::string& scale, const std::string& keyboard_map) {
    const auto notes = load<Scale>(scale, parse_scale);
    if (!notes) return notes.error();
    KeyboardMap map;
    if (!keyboard_map.empty()) {
        auto loaded = load<KeyboardMap>(keyboard_map, parse_keyboard_map);
        if (!loaded) return loaded.error();
        map = std::move(loaded.value());
    }
    auto frequencies = tune(notes.value(), map);
    if (!frequencies) return invalid_input(keyboard_map, frequencies.failure());
    return frequencies.value();
}

}  // namespace jawari::host
