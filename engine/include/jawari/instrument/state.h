// Everything that changes while an instrument plays: plain data, fully initialised by
// make_instrument_state().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "jawari/detail/string_state.h"
#include "jawari/detail/touches.h"
#include "jawari/instrument/model.h"
#include "jawari/parameters.h"

namespace jawari {

enum class VoicePhase {
    Idle,      ///< at rest, costs nothing
    Sounding,  ///< the string's note
    Damped     ///< an earlier note, under the damping hand if there is one
};

/// A motion's own copy of its string, at another tension.
struct BendState {
    bool active = false;   ///< `model` is in force
    double semitones = 0;  ///< bend in force
    double target = 0;     ///< where it goes [semitones]
    StringModel model;
    AlignedVector<double> backward_q, backward_u;  ///< as StoppedStringModel's, of `model`
};

/// A slide: the pitch glides to another fret's, which then takes over.
struct SlideState {
    bool active = false;
    std::size_t fret = 0;
    double begun = 0;      ///< semitones at which it began, 0 unless another slide was under way
    double semitones = 0;  ///< from this fret to that
    std::uint64_t frame = 0, frames = 0;
};

/// How a motion is heard.
struct VoiceGains {
    double level = 0;            ///< volume and expression, with the string's level
    double left = 0, right = 0;  ///< of the place between left and right
    double body = 0;             ///< share of its force that drives the body
    double mix = 0.5;            ///< of the pickups
};

/// One motion of one string: from its excitation until it is at rest.
struct Voice {
    VoicePhase phase = VoicePhase::Idle;
    std::size_t fret = 0;
    int channel = 0;
    StringState string;  ///< sized for the largest of the string's stops
    TouchState touches;
    BendState bend;
    SlideState slide;
    std::uint64_t age = 0;            ///< frames since it began
    bool fading = false;              ///< being taken away, see render_instrument()
    bool rests_on_obstacles = false;  ///< its stop holds energy at rest
    std::size_t fade_frame = 0;
    std::size_t rise_frame = 0;  ///< of fading in after legato; at the shape's end: fully in
    VoiceGains gains;            ///< in force, following the target smoothly
    VoiceGains targets;
};

/// The note that occupies a course, from note-on until it is released (by note-off, or the pedal).
struct HeldNote {
    bool active = false;
    bool key_down = false;  ///< false while only the sustain pedal holds it
    int channel = 0;
    int key = 0;
    std::uint64_t order = 0;  ///< of its note-on; larger is later
    double velocity = 0;
    double bend = std::numeric_limits<double>::quiet_NaN();      ///< of this note [semitones]; NaN: channel's
    double pressure = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the channel's
};

inline constexpr std::size_t legato_depth = 8;

/// Strings that sound together.
struct CourseState {
    HeldNote held;
    /// Legato: keys below the held one that are still down, the latest last.
    std::array<int, legato_depth> below{};
    std::size_t below_count = 0;
};

/// How a note is to be excited.
struct Stroke {
    std::size_t fret = 0;
    double velocity = 0;
    std::size_t exciter = 0;
    int channel = 0;
    double hardness = 1;  ///< factor of release and rise speed, and of felts
};

/// A stroke that waits: for a free motion, or for its turn within a course.
struct PendingStroke {
    bool active = false;
    std::uint64_t delay = 0;  ///< frames until it may begin
    Stroke stroke;
};

/// Motions of a string that can be stopped: 1 sounding, 1 damped and 1 kept free for the next note. One that
/// only sounds open has one.
inline constexpr std::size_t voices_per_string = 3;
inline constexpr std::size_t no_voice = std::numeric_limits<std::size_t>::max();
inline constexpr int midi_channels = 16;

struct InstrumentStringState {
    std::vector<Voice> voices;
    std::size_t sounding = no_voice;
    std::size_t busy = 0;  ///< voices that are not idle
    PendingStroke pending;
    std::size_t rung = 0;  ///< quality at which it is played; set by change_rung()
};

struct ChannelState {
    bool sustain = false;
    double soft = 0;
    double bend = 0;      ///< [semitones]
    double pressure = 0;  ///< 0 to 1
    double timbre = 0.5;  ///< 0 to 1
    std::array<double, parameter_count> parameters{};
};

struct BodyState {
    AlignedVector<double> y, v;
    double force_N = 0;  ///< of the frame before
    bool ringing = false;
    std::uint64_t nonfinite_resets = 0;  ///< times it was put to rest because its state was not finite
};

struct InstrumentCounters {
    std::uint64_t notes = 0;          ///< excited
    std::uint64_t ignored_notes = 0;  ///< out of range, or replaced while waiting for a motion
    std::uint64_t stolen_notes = 0;   ///< held notes whose string was taken by another
    std::uint64_t delayed_notes = 0;  ///< had to wait for a motion to fade, at most fade_s
    std::uint64_t faded_voices = 0;   ///< taken away before they were at rest
    std::uint64_t legato_notes = 0;   ///< carried over from another fret
};

struct InstrumentState {
    PlayMode play = PlayMode::Keyboard;  ///< the preset's; may be changed before the first note
    std::vector<InstrumentStringState> strings;
    std::vector<CourseState> courses;
    std::array<ChannelState, midi_channels> channels;
    BodyState body;
    std::uint64_t note_order = 0;
    std::uint64_t frame = 0;          ///< frames rendered
    bool waiting = false;             ///< a stroke may be waiting
    bool busy = false;                ///< a string may have a motion
    std::uint64_t strokes_until = 0;  ///< waiting strokes have been looked at up to this frame
    InstrumentCounters counters;
    PlayerWork work;
    Counters finished;  ///< contact counters of motions that are idle again
};

/// All strings at rest. Allocates all that rendering needs.
InstrumentState make_instrument_state(const InstrumentModel& model);

/// Contact counters of all motions, finished and sounding.
Counters contact_counters(const InstrumentState& state);

/// Whether every motion is idle, nothing is waiting and the body is still.
bool at_rest(const InstrumentState& state) noexcept;

}  // namespace jawari
