#include "commands/play/monitor_text.h"

#include <array>

#include "base/text.h"

namespace jawari::host {

namespace {

struct ControllerName {
    int number;
    const char* name;
};

/// "MIDI 1.0 Detailed Specification", table III, as far as docs/formats/midi.md has them.
constexpr std::array<ControllerName, 30> controllers{{
    {0, "bank"},
    {1, "modulation"},
    {2, "breath"},
    {4, "foot"},
    {6, "data entry"},
    {7, "volume"},
    {10, "pan"},
    {11, "expression"},
    {32, "bank, fine"},
    {38, "data entry, fine"},
    {64, "sustain"},
    {66, "sostenuto"},
    {67, "soft pedal"},
    {68, "legato"},
    {71, "resonance"},
    {74, "timbre"},
    {88, "velocity, fine"},
    {96, "data increment"},
    {97, "data decrement"},
    {98, "NRPN, fine"},
    {99, "NRPN"},
    {100, "RPN, fine"},
    {101, "RPN"},
    {120, "all sound off"},
    {121, "reset all controllers"},
    {122, "local control"},
    {123, "all notes off"},
    {124, "omni off"},
    {126, "mono"},
    {127, "poly"},
}};

const char* controller_name(int number) {
    for (const ControllerName& each : controllers)
        if (each.number == number) return each.name;
    return "";
}

}  // namespace

std::string key_name(int key) {
    constexpr std::array<const char*, 12> names{"C",  "C#", "D",  "D#", "E",  "F",
                                                "F#", "G",  "G#", "A",  "A#", "B"};
    return names[static_cast<std::size_t>(key % 12)] + std::to_string(key / 12 - 1);
}

std::string message_text(const ChannelMessage& message) {
    const int channel = channel_of(message) + 1;
    const int first = message.data1;
    const int second = message.data2;
    const std::string key = key_name(first);
    switch (kind_of(message)) {
        case MessageKind::NoteOn:
            if (second == 0) break;
            return formatted("ch %-2d note on     %-4s (%d)  velocity %d", channel, key.c_str(), first,
                             second);
        case MessageKind::PolyPressure:
            return formatted("ch %-2d pressure    %-4s (%d)  %d", channel, key.c_str(), first, second);
        case MessageKind::ControlChange:
            return formatted("ch %-2d controller  %d %s: %d", channel, first, controller_name(first), second);
        case MessageKind::ProgramChange:
            return formatted("ch %-2d program     %d", channel, first);
        case MessageKind::ChannelPressure:
            return formatted("ch %-2d pressure    %d", channel, first);
        case MessageKind::PitchBend:
            return formatted("ch %-2d bend        %+d", channel, second * 128 + first - 8192);
        case MessageKind::NoteOff:
            break;
    }
    return formatted("ch %-2d note off    %-4s (%d)  velocity %d", channel, key.c_str(), first, second);
}

}  // namespace jawari::host
