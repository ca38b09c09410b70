#include "window/model/keyboard.h"

#include <algorithm>
#include <array>

namespace jawari::host::window {

namespace {

constexpr int octave = 12;
constexpr std::array<bool, octave> is_black{false, true,  false, true,  false, false,
                                            true,  false, true,  false, true,  false};
constexpr float black_height = 0.62F;
constexpr float black_width = 0.62F;

}  // namespace

std::vector<PianoKey> piano_keys(const Box& box, int lowest, int highest) {
    int first = std::clamp(lowest, 0, 127) / octave * octave;
    int last = std::clamp(highest, 0, 127) / octave * octave + octave - 1;
    while (last - first + 1 < 2 * octave) last += octave;
    last = std::min(last, 127);
    first = std::min(first, last - 1);
    int whites = 0;
    for (int key = first; key <= last; ++key)
        whites += is_black[static_cast<std::size_t>(key % octave)] ? 0 : 1;
    const float width = box.width / static_cast<float>(whites);
    std::vector<PianoKey> white;
    std::vector<PianoKey> black;
    float x = box.x;
    for (int key = first; key <= last; ++key) {
        if (is_black[static_cast<std::size_t>(key % octave)]) {
            black.push_back(
                {key,
                 true,
                 {x - width * black_width / 2, box.y, width * black_width, box.height * black_height}});
        } else {
            white.push_back({key, false, {x, box.y, width, box.height}});
            x += width;
        }
    }
    white.insert(white.end(), black.begin(), black.end());
    return white;
}

std::optional<int> key_at(const std::vector<PianoKey>& keys, float x, float y) {
    const auto key =
        std::find_if(keys.rbegin(), keys.rend(), [&](const PianoKey& one) { return one.box.has(x, y); });
    return key == keys.rend() ? std::nullopt : std::optional(key->key);
}

double velocity_at(const PianoKey& key, float y) {
    const double share = static_cast<double>((y - key.box.y) / key.box.height);
    return std::clamp(0.2 + 0.8 * share, 0.2, 1.0);
}

}  // namespace jawari::host::window
