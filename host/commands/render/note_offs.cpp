#include "commands/render/note_offs.h"

#include <cstdint>
#include <unordered_map>

namespace jawari::host {

std::vector<MidiEvent> with_note_offs(const std::vector<MidiEvent>& events) {
    struct Key {
        std::uint64_t open = 0, forgotten = 0;
    };
    const auto key_of = [](const MidiEvent& event) {
        return (std::uint32_t{event.port} << 11U) | (std::uint32_t{event.status} & 0xFU) << 7U | event.data1;
    };
    const auto is_note = [](const MidiEvent& event) {
        return (event.status & 0xE0) == 0x80;  // 0x80 and 0x90
    };
    const auto is_on = [](const MidiEvent& event) { return event.status >= 0x90 && event.data2 > 0; };
    std::unordered_map<std::uint32_t, Key> keys;
    for (const MidiEvent& event : events) {
        if (!is_note(event)) continue;
        Key& key = keys[key_of(event)];
        if (is_on(event)) key.open += 1;
        if (!is_on(event) && key.open > 0) key.open -= 1;
    }
    for (auto& [number, key] : keys) key = {0, key.open};
    std::vector<MidiEvent> whole;
    whole.reserve(events.size());
    for (const MidiEvent& event : events) {
        if (is_note(event)) {
            Key& key = keys[key_of(event)];
            if (is_on(event) && key.open > 0 && key.forgotten > 0) {
                whole.push_back(event);
                whole.back().data2 = 0;
                key.open -= 1;
                key.forgotten -= 1;
            }
            if (is_on(event)) key.open += 1;
            if (!is_on(event) && key.open > 0) key.open -= 1;
        }
        whole.push_back(event);
    }
    return whole;
}

}  // namespace jawari::host
