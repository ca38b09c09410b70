// Arbitrary bytes as a MIDI file: refused with a place, or events in order and in range.
#include <cstdint>

#include "check.h"
#include "formats/midi_file/midi_file.h"

namespace {

using namespace jawari;

void check_events(const host::MidiFile& file) {
    std::uint64_t time = 0;
    for (const host::MidiEvent& event : file.events) {
        fuzz::require(event.time >= time, "events are in order");
        time = event.time;
        fuzz::require(event.status >= 0x80 && event.status < 0xF0, "status of a channel message");
        fuzz::require(event.data1 < 0x80 && event.data2 < 0x80, "data bytes");
        fuzz::require(event.track < file.track_count, "track number");
        fuzz::require(host::frame_of(file, event.time, 48000) <= host::max_midi_duration_s * 48000, "frame");
    }
    fuzz::require(file.end_time >= time, "nothing after the end");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto file = host::parse_midi({data, size});
    if (file) {
        check_events(file.value());
    } else {
        fuzz::require_proper_failure(file.failure());
    }
    return 0;
}
