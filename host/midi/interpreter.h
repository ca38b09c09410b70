// MIDI channel messages -> instrument events: controllers, bends in semitones, modes, MPE, guitar mode. Plain
// state and functions that never allocate, for the audio thread and for files alike (docs/formats/midi.md).
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>

#include "jawari/instrument/render.h"
#include "jawari/realtime.h"
#include "midi/channel_message.h"
#include "midi/midi_map.h"
#include "midi/mpe_zones.h"
#include "midi/system_message.h"

namespace jawari::host {

inline constexpr std::size_t midi_channel_count = 16;

inline constexpr std::size_t midi_key_count = 128;

/// Every parameter as a preset describes it.
constexpr std::array<double, parameter_count> neutral_parameters() {
    std::array<double, parameter_count> values{};
    for (const ParameterDeclaration& parameter : parameter_table())
        values[static_cast<std::size_t>(parameter.id)] = parameter.neutral;
    return values;
}

struct InterpreterSettings {
    int guitar_channel = -1;  ///< 0 to 15: plays guitar_string[0], the next channel guitar_string[1], ...;
                              ///< -1: no guitar mode
    int guitar_strings = 0;   ///< channels of guitar mode
    std::array<int, midi_channel_count> guitar_string{};  ///< string of the instrument for each of them
    double bend_range_semitones = 2;  ///< of channels outside MPE zones until RPN 0 says otherwise, 0 to 96
    MidiMap map = default_midi_map();
    int transpose_semitones = 0;  ///< of every note that is no drum
    /// What the instrument's parameters are before MIDI changes them.
    std::array<double, parameter_count> initial = neutral_parameters();
};

/// Channel of General MIDI's drums, from 0.
inline constexpr int default_drum_channel = 9;

/// What data entry speaks to.
enum class DataTarget { None, Registered, NonRegistered };

struct MidiChannel {
    int bend = 0x2000;                 ///< 14 bits
    double bend_range_semitones = 2;   ///< RPN 0
    double fine_tuning_semitones = 0;  ///< RPN 1, -1 to 1
    int coarse_tuning_semitones = 0;   ///< RPN 2, -64 to 63: next notes sound at another key
    int tuning_program = 0;            ///< RPN 3
    double pressure = 0;               ///< of the channel, 0 to 1
    double timbre = 0.5;               ///< controller 74, 0 to 1
    DataTarget target = DataTarget::None;
    int number_msb = 127, number_lsb = 127;  ///< of the RPN or NRPN; both 127: none
    int data_msb = 0, data_lsb = 0;          ///< of the data entry under way
    int bank_msb = 0, bank_lsb = 0;
    int velocity_lsb = 0;  ///< controller 88, for the next note message
    bool has_velocity_lsb = false;
    bool mono = false;             ///< mode 4: a note ends the one before it
    int mono_key = -1;             ///< the note that is down; -1: none
    std::array<int, 32> coarse{};  ///< last values of controllers 0 to 31, for 14-bit pairs
    bool has_bank = false;         ///< controller 0 has come
    bool rhythm_part = false;      ///< drums unless a bank says otherwise: channel 10, or by GS and XG
    bool unpitched = false;        ///< plays drums or effects now
    double volume = 1;             ///< before the master volume
    double legato = 0;             ///< before portamento
    bool sustain = false, hold_2 = false, sostenuto = false;
    bool portamento = false;
    int portamento_time = 0;  ///< controller 5
    int glide_from = -1;      ///< controller 84: key that the next note slides from; -1: none

    // By the key that the sender names:
    std::array<std::uint8_t, midi_key_count> open{};    ///< note-ons without their note-off
    std::array<std::uint8_t, midi_key_count> sounds{};  ///< key of the instrument, of the latest note-on
    std::array<float, midi_key_count> off_key{};        ///< semitones that it sounds above that key
    std::array<float, midi_key_count> expressed{};      ///< and those that tune_note() adds [semitones]
    std::bitset<midi_key_count> expresses;              ///< tune_note() has been called since it began
    std::bitset<midi_key_count> kept;                   ///< by the sostenuto pedal
    std::bitset<midi_key_count> let_go;                 ///< kept, and its note-off has come
};

/// MIDI Tuning Standard: what notes sound above their keys [semitones].
struct MidiTunings {
    static constexpr std::size_t programs = 128;
    std::array<std::array<float, midi_key_count>, programs> keys{};
    std::array<std::array<float, 12>, midi_channel_count> classes{};  ///< by pitch class, on each channel

    // The change under way:
    int program = 0;
    bool now = false;  ///< sounding notes follow
    int key = -1, semitone = 0, pitch_class = -1;
    unsigned channels = 0;  ///< of an octave tuning, bit c
};

struct MidiInterpreter {
    InterpreterSettings settings;
    MpeZones zones;
    std::array<MidiChannel, midi_channel_count> channels;
    SoundMode mode = SoundMode::Plain;
    double master_volume = 1;          ///< factor of every channel's
    double master_fine_semitones = 0;  ///< part of every bend
    int master_coarse_semitones = 0;   ///< of every note that is no drum
    MidiTunings tunings;
};

/// A program change: the host finds the preset.
struct ProgramRequest {
    bool asked = false;
    int channel = 0;         ///< 0 to 15
    int bank = 0;            ///< controllers 0 and 32: 128 MSB + LSB
    int program = 0;         ///< 0 to 127
    bool unpitched = false;  ///< drums or effects: no instrument has them
};

/// What one message comes to.
struct MidiActions {
    /// Most: a bend of a whole zone whose 128 keys are tuned, on 16 channels.
    std::array<InstrumentEvent, 2304> events{};
    std::size_t count = 0;
    ProgramRequest program;
    bool programs_reset = false;  ///< every channel plays program 0 of bank 0 again
    bool ignored = false;         ///< the message means something, but not here
};

/// The most events that one message comes to.
inline constexpr std::size_t most_events_per_message = std::tuple_size_v<decltype(MidiActions::events)>;

MidiInterpreter make_interpreter(const InterpreterSettings& settings);

/// Replaces `actions`. The events' frames are not set. Messages with bytes out of range come to nothing.
/// Takes SystemKind messages (system_message.h) too.
void interpret(MidiInterpreter& interpreter, const ChannelMessage& message,
               MidiActions& actions) JAWARI_REALTIME;

/// The channel whose instrument plays this channel's notes: its zone's manager; the guitar's first channel;
/// or the channel itself.
int part_channel(const MidiInterpreter& interpreter, int channel) JAWARI_REALTIME;

}  // namespace jawari::host
