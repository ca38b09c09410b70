#include "render/midi_events.h"

#include <optional>

namespace jawari::host {

namespace {

constexpr std::uint8_t controller_sustain = 64;
constexpr std::uint8_t controller_all_sound_off = 120;
constexpr std::uint8_t controller_all_notes_off = 123;  // and the mode changes 124 to 127, which imply it
constexpr unsigned bend_centre = 0x2000;

std::optional<InstrumentEventType> controller_event(std::uint8_t controller) {
    if (controller == controller_sustain) return InstrumentEventType::Sustain;
    if (controller == controller_all_sound_off) return InstrumentEventType::AllSoundOff;
    if (controller >= controller_all_notes_off) return InstrumentEventType::AllNotesOff;
    return std::nullopt;
}

std::optional<InstrumentEvent> instrument_event(const MidiEvent& message) {
    InstrumentEvent event;
    event.channel = message.status & 0x0F;
    event.key = message.data1;
    event.value = message.data2 / 127.0;
    switch (message.status & 0xF0) {
        case 0x90:
            event.type = InstrumentEventType::NoteOn;  // velocity 0 is a note-off
            return event;
        case 0x80:
            event.type = InstrumentEventType::NoteOff;
            return event;
        case 0xB0:
            if (const auto type = controller_event(message.data1)) {
                event.type = *type;
                return event;
            }
            return std::nullopt;
        default:
            return std::nullopt;
    }
}

bool is_pitch_bend(const MidiEvent& message) {
    const unsigned bend = message.data1 | static_cast<unsigned>(message.data2) << 7U;
    return (message.status & 0xF0) == 0xE0 && bend != bend_centre;
}

}  // namespace

MidiScore midi_score(const MidiFile& file, std::uint32_t rate_hz) {
    MidiScore score;
    for (const MidiEvent& message : file.events) {
        if (is_pitch_bend(message)) score.pitch_bends += 1;
        if (const auto event = instrument_event(message)) {
            score.events.push_back({frame_of(file, message.time, rate_hz), *event});
        }
    }
    score.end_frame = frame_of(file, file.end_time, rate_hz);
    return score;
}

}  // namespace jawari::host
