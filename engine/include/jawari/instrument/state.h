// Everything that changes while an instrument plays: plain data, fully initialised by
// make_instrument_state(). A copy is a snapshot. Hosts read and set it through the functions at the end.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "jawari/detail/end_run.h"
#include "jawari/detail/index_list.h"
#include "jawari/detail/string_state.h"
#include "jawari/detail/touches.h"
#include "jawari/instrument/model.h"
#include "jawari/parameters.h"
#include "jawari/realtime.h"
#include "jawari/scene/counters.h"

namespace jawari {

/// What a voice is doing.
enum class VoicePhase {
    Idle,      ///< at rest, costs nothing
    Sounding,  ///< the string's note
    Damped,    ///< an earlier note, under the damping hand if there is one
    Answering  ///< an open string that nobody plays, which a moving bridge drives
};

/// A voice's own copy of its string, at another tension.
struct BendState {
    bool active = false;                  ///< `model` is in force
    double semitones = 0;                 ///< bend in force
    double target = 0;                    ///< where it goes [semitones]
    StringModel model;                    ///< the string at that tension
    AlignedVector<double> backward_q;     ///< StoppedStringModel::backward_q, of `model`
    AlignedVector<double> backward_u;     ///< StoppedStringModel::backward_u, of `model`
    double growth = 1;                    ///< tension over compiled tension, if the bridge moves
    double bridge_stiffness_N_per_m = 0;  ///< StoppedStringModel::bridge_stiffness_N_per_m, of `model`
};

/// A slide: the pitch glides to another fret's, which then takes over.
struct SlideState {
    bool active = false;       ///< a slide is under way
    std::size_t fret = 0;      ///< where it goes
    double begun = 0;          ///< bend at which it began [semitones]; 0 unless another slide was under way
    double semitones = 0;      ///< from the voice's fret to `fret`
    std::uint64_t frame = 0;   ///< output frames since it began
    std::uint64_t frames = 0;  ///< output frames that it takes
};

/// How a voice is heard.
struct VoiceGains {
    double level = 0;  ///< volume times expression times the string's level
    double left = 0;   ///< factor of the left channel, sqrt(2) cos of the pan's angle
    double right = 0;  ///< factor of the right channel, sqrt(2) sin of the pan's angle
    double body = 0;   ///< share of its bridge force that drives the body
    double mix = 0.5;  ///< ParameterId::PickupMix
};

/// What a change of quality level took from what outputs read of a voice: modes that are left out, and the
/// moment of velocities, which are those of the contact step before. It fades as a voice does (fade_shape).
struct QualityRemainder {
    bool active = false;    ///< the fields below hold
    double pickups = 0;     ///< before the voice's gains [unit of the pickups]
    double bridge_N = 0;    ///< before the voice's gains [N]
    std::size_t frame = 0;  ///< index into InstrumentModel::fade_shape
};

/// A voice's end on a bridge that moves, as the last frame had it.
struct BridgeEnd {
    /// How the voice acts on the bridge: it feels weight times the bridge's displacement, and the bridge
    /// weight times its force. Fades, the string's level and its tension are in it; 0: not at all.
    double weight = 0;
    double stiffness_N_per_m = 0;  ///< kappa at the voice's tension [N/m]
    double force_N = 0;            ///< at the frame's end, before the weight [N]
};

/// One voice of one string: a motion from its excitation until it is at rest.
struct Voice {
    VoicePhase phase = VoicePhase::Idle;  ///< what it is doing
    std::size_t fret = 0;                 ///< at which its string is stopped, 0 is open
    int channel = 0;                      ///< 0 to 15
    StringState string;                   ///< sized for the largest of the string's stops and quality levels
    TouchState touches;                   ///< hands and exciter
    BendState bend;                       ///< retuned string
    SlideState slide;                     ///< in legato
    std::uint64_t age = 0;                ///< output frames since it began
    bool fading = false;                  ///< being taken away, see render_instrument()
    bool rests_on_obstacles = false;      ///< its stop holds energy at rest
    std::size_t fade_frame = 0;           ///< index into InstrumentModel::fade_shape while fading
    std::size_t rise_frame = 0;           ///< of fading in after legato; at the shape's end: fully in
    QualityRemainder remainder;           ///< of the last change of quality level
    BridgeEnd end;                        ///< on a bridge that moves
    EndRun run;                           ///< of frames that it flies together on a bridge that moves
    VoiceGains gains;                     ///< in force; they follow `targets` smoothly
    VoiceGains targets;                   ///< set every 32 output frames from the channel's controls
};

/// The note that occupies a course, from note-on until it is released by note-off or by the pedal.
struct HeldNote {
    bool active = false;                                     ///< a note is held
    bool key_down = false;                                   ///< false while only the sustain pedal holds it
    int channel = 0;                                         ///< 0 to 15
    int key = 0;                                             ///< MIDI note number
    std::uint64_t order = 0;                                 ///< of its note-on; larger is later
    double velocity = 0;                                     ///< above 0, to 1
    double bend = std::numeric_limits<double>::quiet_NaN();  ///< its own bend [semitones]; NaN: channel's
    double pressure = std::numeric_limits<double>::quiet_NaN();  ///< its own, 0 to 1; NaN: the channel's
    double level = 1;  ///< factor of its sound, 0 to most_note_level
    double pan = 0;    ///< added to its place, -1 to 1
};

/// Keys that a course remembers below the held one in legato; the oldest is forgotten.
inline constexpr std::size_t legato_depth = 8;

/// Strings that sound together.
struct CourseState {
    HeldNote held;  ///< the note that occupies the course
    /// Legato: keys below the held one that are still down, the latest last; below_count are valid.
    std::array<int, legato_depth> below{};
    std::size_t below_count = 0;  ///< valid keys in `below`
};

/// How a note is to be excited.
struct Stroke {
    std::size_t fret = 0;     ///< 0 is the open string
    double velocity = 0;      ///< above 0, to 1
    std::size_t exciter = 0;  ///< index into InstrumentModel::exciters
    int channel = 0;          ///< 0 to 15
    double hardness = 1;      ///< factor of release and rise speed, and of the felts' stiffness
};

/// A stroke that waits: for an idle voice, or for its turn within a course.
struct PendingStroke {
    bool active = false;      ///< a stroke waits
    std::uint64_t delay = 0;  ///< output frames until it may begin
    Stroke stroke;            ///< the stroke that waits
};

/// Voices of a string that can be stopped: one sounds, one fades, one is kept free for the next note. A
/// string that only sounds open has one.
inline constexpr std::size_t voices_per_string = 3;
/// Index of no voice.
inline constexpr std::size_t no_voice = std::numeric_limits<std::size_t>::max();
/// Channels of an instrument, as MIDI has them.
inline constexpr int midi_channels = 16;

/// One string of the instrument.
struct InstrumentStringState {
    std::vector<Voice> voices;        ///< voices_per_string, or one
    std::size_t sounding = no_voice;  ///< index of the voice that has the note, or no_voice
    std::size_t busy = 0;             ///< voices that are not idle
    PendingStroke pending;            ///< the stroke that waits, if any
    std::size_t quality_level = 0;    ///< quality level, 0 is full; set by change_quality()
};

/// Controllers and parameters of one channel.
struct ChannelState {
    bool sustain = false;                              ///< sustain pedal down
    double soft = 0;                                   ///< soft pedal, 0 (up) to 1 (down)
    double bend = 0;                                   ///< [semitones]
    double pressure = 0;                               ///< 0 to 1
    double timbre = 0.5;                               ///< 0 to 1
    std::array<double, parameter_count> parameters{};  ///< by ParameterId, in their units
};

/// Resonances of the body.
struct BodyState {
    AlignedVector<double> y;             ///< displacement of each mode [m kg^(1/2), a mode weighs 1 kg]
    AlignedVector<double> v;             ///< velocity of each mode [m/s]
    double force_N = 0;                  ///< driving force of the frame before [N]
    bool ringing = false;                ///< not at rest
    std::uint64_t nonfinite_resets = 0;  ///< times it was put to rest because its state was not finite
};

/// A voice in the frame of a moving bridge: scratch.
struct VoiceOnBridge {
    std::size_t string = 0;  ///< index
    std::size_t voice = 0;   ///< index of the string's voice
    double weight = 0;       ///< BridgeEnd::weight in the frame; 0 also if its numbers are not finite
    double zeta_m = 0;       ///< mean displacement of the bridge as the voice feels it [m]
    double rest_N = 0;       ///< StoppedStringModel::end_rest_N of the voice, in steady frames [N]
    double left_N = 0;       ///< by which contacts have changed the force at the frame's end [N]
    bool in_run = false;     ///< it flies in a run (EndRun)
    BridgeEndFrame frame;    ///< what it answers
};

/// The body under a moving bridge, and what a frame needs to solve. Arrays over modes are BridgeModel::stride
/// long.
struct BridgeState {
    AlignedVector<double> y;  ///< displacement of each mode [m]
    AlignedVector<double> v;  ///< velocity of each mode [m/s]
    /// What contacts within frames have left unbalanced so far; energy of strings, body and coupling plus
    /// this obeys the balance [J].
    double debt_J = 0;
    double level = 0;                    ///< factor of what is heard, follows the controls of `channel`
    int channel = 0;                     ///< of the last note
    std::uint64_t answers_from = 0;      ///< output frame before which no open string begins to answer
    bool ringing = false;                ///< not at rest
    bool drives = false;                 ///< it moves enough for open strings to answer
    std::uint64_t nonfinite_resets = 0;  ///< times it was put to rest because its state was not finite

    // -- the system of a frame: (2/y_held + sum_i couplings_i shape_i shape_i') delta = right
    std::vector<double> couplings;  ///< weight^2 stiffness of each voice as in `matrix`, 0: none [N/m]
    AlignedVector<double> matrix;   ///< modes x stride, lower triangle [N/m]
    AlignedVector<double> factor;   ///< its Cholesky factor, and the diagonal's inverses behind it
    bool stale = true;              ///< `matrix` must be summed anew
    bool summed = false;            ///< `matrix` has not been updated since it was summed
    /// The same by voices, where they are fewer than modes: how many `factor` was made
    /// of, and string, weight and stiffness of each.
    std::vector<double> factorised;
    AlignedVector<double> pull;         ///< force of each voice, in the mean of the frame [N]
    std::vector<double> under_mean;     ///< mean displacement under each string in free motion [m]
    std::vector<double> string_pull;    ///< of the voices of each string together, if it is sounding [N]
    IndexList sounding;                 ///< strings with voices in the frame
    AlignedVector<double> mean;         ///< mean displacement in the frame [m]
    AlignedVector<double> force_N;      ///< held in the frame [N]
    AlignedVector<double> path;         ///< change of y over the frame [m]
    AlignedVector<double> solution;     ///< scratch
    std::vector<VoiceOnBridge> voices;  ///< scratch, room for all
    std::size_t voice_count = 0;        ///< voices of the frame
    /// For outputs of strings: what of the body's motion each string has caused, strings x stride.
    AlignedVector<double> y_of;
    AlignedVector<double> v_of;  ///< the same of velocities
    bool separates = false;      ///< outputs of strings are asked for
};

/// What the instrument has counted since make_instrument_state() or reset().
struct InstrumentCounters {
    std::uint64_t notes = 0;          ///< excited
    std::uint64_t ignored_notes = 0;  ///< no string has them, or replaced while waiting for a voice
    std::uint64_t stolen_notes = 0;   ///< held notes whose string was taken by another
    std::uint64_t delayed_notes = 0;  ///< had to wait for a voice to fade, at most fade_s
    std::uint64_t faded_voices = 0;   ///< taken away before they were at rest
    std::uint64_t legato_notes = 0;   ///< taken over from another fret
};

/// Adds the counts of `more`. Threads: any; realtime-safe.
InstrumentCounters& operator+=(InstrumentCounters& sum, const InstrumentCounters& more) JAWARI_REALTIME;

/// Places of a string by which impulses are added up (motion.h).
inline constexpr std::size_t impact_places = 96;

/// Impulses of strings on their obstacles, by string and place; watch_impacts() opens it.
struct ImpactLog {
    bool open = false;                 ///< impulses are added up
    std::vector<float> sums_Ns;        ///< strings x impact_places [N s]
    std::vector<std::uint8_t> struck;  ///< by string: something was added
    std::vector<double>
        places_per_metre;  ///< by string: impact_places over its longest speaking length [1/m]
};

/// An instrument while it plays. One thread at a time may use it.
struct InstrumentState {
    PlayMode play = PlayMode::Keyboard;                ///< set by set_play_mode()
    std::vector<InstrumentStringState> strings;        ///< as InstrumentModel::strings
    std::vector<CourseState> courses;                  ///< as InstrumentModel::courses
    std::array<ChannelState, midi_channels> channels;  ///< controllers and parameters of each channel
    BodyState body;                                    ///< resonances of the body that listen
    BridgeState bridge;                                ///< resonances of the body that move the bridge
    /// The body as each string alone drives it, for outputs of strings; empty without a body.
    std::vector<BodyState> string_bodies;
    std::uint64_t note_order = 0;     ///< HeldNote::order of the next note-on
    std::uint64_t frame = 0;          ///< output frames rendered
    bool waiting = false;             ///< a stroke may be waiting
    bool busy = false;                ///< a string may have a voice that is not idle
    std::uint64_t strokes_until = 0;  ///< waiting strokes have been looked at before this output frame
    InstrumentCounters counters;      ///< notes and voices
    ImpactLog impacts;                ///< for pictures; does not change the sound
    PlayerWork work;                  ///< energies that players have given to the strings
    Counters finished;                ///< contact counters of voices that are idle again
};

/// A state of the model: all strings at rest, controllers neutral. Allocates all that rendering needs.
/// Threads: any.
InstrumentState make_instrument_state(const InstrumentModel& model);

/// Returns the state to what make_instrument_state(model) gives: silence, neutral controllers and parameters,
/// full quality, the model's play mode, counters and clock at 0. What is rendered from then on has the same
/// bits as from a new state. `state` must have been made for `model`. Threads: one at a time per state;
/// realtime-safe.
void reset(const InstrumentModel& model, InstrumentState& state) JAWARI_REALTIME;

/// Gives `to` the controllers and parameters of all channels of `from`, as when one instrument takes the
/// place of another. Held notes stay. Threads: one at a time per state; realtime-safe.
void inherit_controls(const InstrumentState& from, InstrumentState& to) JAWARI_REALTIME;

/// Sets how strings are given to notes, which make_instrument_state() and reset() take from the model. Call
/// it before the first note. Threads: one at a time per state; realtime-safe.
void set_play_mode(InstrumentState& state, PlayMode mode) JAWARI_REALTIME;

/// Sets the number of output frames rendered. Vibrato and the moments at which controllers are followed count
/// from frame 0. Call it between blocks. Threads: one at a time per state; realtime-safe.
void set_clock(InstrumentState& state, std::uint64_t frame) JAWARI_REALTIME;

/// Whether a note holds string `string` (index): a key is down, or the sustain pedal holds it. Threads: one
/// at a time per state; realtime-safe.
bool is_held(const InstrumentModel& model, const InstrumentState& state, std::size_t string) JAWARI_REALTIME;

/// Number of notes that are held by keys or pedals. Threads: one at a time per state; realtime-safe.
std::size_t held_notes(const InstrumentState& state) JAWARI_REALTIME;

/// Number of voices that are not idle, of all strings. Threads: one at a time per state; realtime-safe.
std::size_t sounding_voices(const InstrumentState& state) JAWARI_REALTIME;

/// Number of voices that are not idle, of string `string` (index). Threads: one at a time per state;
/// realtime-safe.
std::size_t sounding_voices(const InstrumentState& state, std::size_t string) JAWARI_REALTIME;

/// Times that the voices of string `string` (index) that still sound lost their state because it was not
/// finite. Threads: one at a time per state; realtime-safe.
std::uint64_t nonfinite_resets(const InstrumentState& state, std::size_t string) JAWARI_REALTIME;

/// Times that the body, and voices that are idle again, lost their state because it was not finite. With the
/// function above for each string, this is the total. Threads: one at a time per state; realtime-safe.
std::uint64_t finished_nonfinite_resets(const InstrumentState& state) JAWARI_REALTIME;

/// Contact counters of all voices, idle and sounding. Threads: one at a time per state; realtime-safe.
Counters contact_counters(const InstrumentState& state) JAWARI_REALTIME;

/// Whether every voice is idle, no stroke waits and the body is still: rendering gives silence until the next
/// note. Threads: one at a time per state; realtime-safe.
bool at_rest(const InstrumentState& state) JAWARI_REALTIME;

}  // namespace jawari
