// A MIDI file as events of instruments: who plays what, at which frame.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/midi_file/midi_file.h"
#include "jawari/instrument/render.h"
#include "midi/interpreter.h"

namespace jawari::host {

struct TimedEvent {
    std::uint64_t frame = 0;  ///< since the start of the excerpt
    InstrumentEvent event;    ///< its own frame is not set
};

/// One instrument of the piece.
struct ScorePart {
    std::string preset;
    int port = 0;           ///< each port has 16 channels of its own
    int channel = 0;        ///< 0 to 15: its channel, or that of its MPE zone's manager
    unsigned channels = 0;  ///< bit c: notes of channel c
    std::uint64_t notes = 0;
    PlayMode play = PlayMode::Keyboard;
    std::vector<TimedEvent> events;  ///< in order of time
};

/// Messages of one kind that do nothing here.
struct IgnoredKind {
    std::string what;  ///< `controller 91 (reverb)`
    std::uint64_t count = 0;
};

/// Notes that a preset has no string for, and who plays them.
struct LentNotes {
    std::string preset, player;
    std::uint64_t count = 0;
};

/// What part of a piece is played [frames]. Messages before it change what they change without being heard;
/// notes that begin before it are left out.
struct Excerpt {
    std::uint64_t begin = 0;
    std::uint64_t end = std::numeric_limits<std::uint64_t>::max();
};

struct Score {
    std::vector<ScorePart> parts;      ///< in order of their first note
    std::vector<IgnoredKind> ignored;  ///< by name
    std::uint64_t end_frame = 0;       ///< of the last event or end of track, or of the excerpt
    std::uint64_t whole_frames = 0;    ///< end of the piece, if all of it were played
    std::uint64_t silent_notes = 0;    ///< of drums, of programs without a preset, and beside guitar mode
    std::uint64_t muted_notes = 0;     ///< left out as asked for
    std::uint64_t cut_notes = 0;       ///< down where the excerpt begins, and not played
    std::uint64_t program_changes = 0;
    std::vector<LentNotes> lent_notes;
};

/// Preset of a program; nothing: its notes are silent.
using ProgramChoice = std::function<std::optional<std::string>(int bank, int program)>;

/// Preset that plays a key of a preset: itself, or another one if it has no such string.
using KeyChoice = std::function<std::string(const std::string& preset, int key)>;

struct ScoreRules {
    InterpreterSettings interpreter;
    /// Each channel (MPE zone, guitar) is a part for itself, for each preset that its programs choose. Empty:
    /// all channels of a port play one part, program changes do nothing.
    ProgramChoice choose;
    KeyChoice choose_for_key;                                ///< beside `choose`; empty: always itself
    std::string preset;                                      ///< of the one part
    double tempo = 1;                                        ///< times as fast as written
    unsigned muted = 0;                                      ///< bit c: notes of channel c are left out
    Excerpt excerpt;                                         ///< frames of the piece at its tempo
    std::vector<std::pair<ParameterId, double>> parameters;  ///< set at the start, in each parameter's unit
};

/// A program change holds for notes that begin after it; what sounds rings on, and hears its note-offs,
/// pedals and bends. Parts exist if they have a note.
Score make_score(const MidiFile& file, std::uint32_t rate_hz, const ScoreRules& rules);

/// At the end of the score pedals go up and keys that are still down are let go, so that a file which forgets
/// its note-offs comes to an end.
void end_notes(Score& score);

}  // namespace jawari::host
