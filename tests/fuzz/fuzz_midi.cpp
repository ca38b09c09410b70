// Arbitrary bytes as a MIDI file, read strictly and leniently: refused with a place, or events in order and
// in range. What is accepted strictly, a lenient reading plays too.
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
        fuzz::require(event.status >= 0x80 && event.status <= host::exclusive_status, "status");
        fuzz::require(event.status < 0xF0 || event.exclusive < file.exclusives.size(), "exclusive message");
        fuzz::require(event.port < 128, "port");
        fuzz::require(event.data1 < 0x80 && event.data2 < 0x80, "data bytes");
        fuzz::require(event.track < file.track_count, "track number");
        fuzz::require(host::frame_of(file, event.time, 48000) <= host::max_midi_duration_s * 48000, "frame");
    }
    fuzz::require(file.end_time >= time, "nothing after the end");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto strict = host::parse_midi({data, size});
    const auto lenient = host::parse_midi({data, size}, host::MidiReading::Lenient);
    for (const auto* file : {&strict, &lenient}) {
        if (file->ok()) {
            check_events(file->value());
        } else {
            fuzz::require_proper_failure(file->failure());
        }
    }
    if (!strict) return 0;
    fuzz::require(strict.value().repairs.empty(), "a strict reading repairs nothing");
    fuzz::require(lenient.ok(), "a lenient reading takes what a strict one takes");
    const bool cut = !lenient.value().repairs.empty();  // what comes long after the last note is left out
    fuzz::require(cut || lenient.value().events.size() >= strict.value().events.size(), "the same events");
    return 0;
}
