// Music as `jawari render` plays it, into memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "commands/render/options.h"
#include "formats/midi_file/midi_file.h"
#include "recording.h"

namespace jawari::python {

struct PresetSource {
    std::string name = host::automatic_preset;  ///< a file or a name, as --preset takes it
    std::optional<std::string> text;            ///< a preset's JSON; `name` is what messages call it
};

struct Played {
    std::vector<double> sound;  ///< interleaved, left first
    std::vector<std::string>
        notices;  ///< what was repaired in the music, ignored or silent, and what is doubtful
};

/// What `--format float` would write, before it is rounded to 32 bits. `options`: of those that a rendering
/// to memory has a use for; its preset is set here.
host::Outcome<Played> play(const host::MidiFile& file, const PresetSource& preset,
                           host::RenderOptions options, const Poll& poll);

/// A MIDI file's bytes; problems name `name`.
host::Outcome<host::MidiFile> read_midi(const std::string& bytes, const std::string& name);

/// A channel message at a time.
struct TimedMessage {
    double time_s = 0;
    std::uint8_t status = 0, data1 = 0, data2 = 0;
};

/// As a MIDI file whose times are frames, each to the nearest; messages of one time stay in order.
host::MidiFile as_midi(std::vector<TimedMessage> messages, std::uint32_t rate_hz);

}  // namespace jawari::python
