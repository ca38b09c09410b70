#include "commands/render/preset_keys.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "instrument/preset_library.h"
#include "instrument/program_presets.h"

namespace jawari::host {

namespace {

template <std::size_t N>
bool has(const std::bitset<N>& keys, int key) {
    return key >= 0 && key < static_cast<int>(N) && keys[static_cast<std::size_t>(key)];
}

template <std::size_t N>
int lowest_of(const std::bitset<N>& keys) {
    int key = 0;
    while (key < static_cast<int>(N) && !has(keys, key)) ++key;
    return key;
}

template <std::size_t N>
int highest_of(const std::bitset<N>& keys) {
    int key = static_cast<int>(N) - 1;
    while (key >= 0 && !has(keys, key)) --key;
    return key;
}

}  // namespace

PresetKeys::PresetKeys(InstrumentSettings settings) : settings_(std::move(settings)) {}

const PresetKeys::Keys& PresetKeys::keys_of(const std::string& preset) {
    const auto [found, is_new] = keys_.try_emplace(preset);
    if (!is_new || !preset_exists(preset)) return found->second;
    const auto loaded = load_with(preset, settings_);
    if (!loaded) return found->second;  // whoever compiles it says why
    const InstrumentDescription& instrument = loaded.value().instrument;
    for (const InstrumentStringDescription& string : instrument.strings) {
        const FretsDescription& frets = string.frets ? *string.frets : instrument.frets;
        for (std::size_t fret = 0; fret <= frets.count; ++fret) {
            const int rise =
                fret == 0 || frets.semitones.empty() ? static_cast<int>(fret) : frets.semitones[fret - 1];
            const int key = string.open_note + rise;
            if (key >= 0 && key < static_cast<int>(Keys{}.size()))
                found->second.set(static_cast<std::size_t>(key));
        }
    }
    return found->second;
}

std::string PresetKeys::player_of(const std::string& preset, int key) {
    const std::lock_guard lock(mutex_);
    const Keys& own = keys_of(preset);
    if (own.none() || (key >= lowest_of(own) && key <= highest_of(own))) return preset;
    const auto neighbours = neighbour_presets(preset, key < lowest_of(own));
    const auto found = std::find_if(neighbours.begin(), neighbours.end(), [&](std::string_view name) {
        return has(keys_of(std::string(name)), key);
    });
    return found == neighbours.end() ? preset : std::string(*found);
}

}  // namespace jawari::host
