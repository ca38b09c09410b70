// Everything that changes while an instrument plays: plain data, fully initialised by
// make_instrument_state().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "jawari/instrument_model.h"
#include "jawari/state.h"

namespace jawari {

enum class VoicePhase {
    Idle,      ///< at rest, costs nothing
    Sounding,  ///< the string's note
    Damped     ///< an earlier note under the damping hand
};

/// One motion of one string: a note from its pluck until it is at rest.
struct Voice {
    VoicePhase phase = VoicePhase::Idle;
    std::size_t fret = 0;
    StringState string;        ///< sized for the open string, the largest
    std::uint64_t age = 0;     ///< frames since the pluck began
    double pluck_force_N = 0;  ///< peak of the finger's force
    bool fading = false;       ///< being taken away, see render_instrument()
    std::size_t fade_frame = 0;
};

/// The note that occupies a string, from note-on until it is released (by note-off, or the pedal).
struct HeldNote {
    bool active = false;
    bool key_down = false;  ///< false while only the sustain pedal holds it
    int channel = 0;
    int key = 0;
    std::uint64_t order = 0;  ///< of its note-on; larger is later
};

/// A note waiting for a voice.
struct PendingNote {
    bool active = false;
    std::size_t fret = 0;
    double velocity = 0;
};

/// 1 sounding, 2 damped and 1 kept free for the next note.
inline constexpr std::size_t voices_per_string = 4;
inline constexpr std::size_t no_voice = voices_per_string;
inline constexpr int midi_channels = 16;

struct InstrumentStringState {
    std::array<Voice, voices_per_string> voices;
    std::size_t sounding = no_voice;
    HeldNote held;
    PendingNote pending;
};

struct InstrumentCounters {
    std::uint64_t notes = 0;          ///< plucked
    std::uint64_t ignored_notes = 0;  ///< out of range, or replaced while waiting for a voice
    std::uint64_t stolen_notes = 0;   ///< held notes whose string was taken by another
    std::uint64_t delayed_notes = 0;  ///< had to wait for a voice to fade, at most fade_s
    std::uint64_t faded_voices = 0;   ///< taken away before they were at rest
};

struct InstrumentState {
    std::vector<InstrumentStringState> strings;
    std::array<bool, midi_channels> sustain{};
    std::uint64_t note_order = 0;
    std::uint64_t frame = 0;  ///< frames rendered
    InstrumentCounters counters;
    Counters finished;  ///< contact counters of voices that are idle again
};

/// All strings at rest. Allocates all that rendering needs.
InstrumentState make_instrument_state(const InstrumentModel& model);

/// Contact counters of all voices, finished and sounding.
Counters contact_counters(const InstrumentState& state);

/// Whether every voice is idle and no note is waiting.
bool at_rest(const InstrumentState& state) noexcept;

}  // namespace jawari
