// MIDI channel messages -> instrument events: controllers, bends in semitones, modes, MPE, guitar mode. Plain
// state and functions that never allocate, for the audio thread and for files alike (docs/formats/midi.md).
#pragma once

#include <array>
#include <cstddef>

#include "jawari/instrument/render.h"
#include "jawari/realtime.h"
#include "midi/channel_message.h"
#include "midi/midi_map.h"
#include "midi/mpe_zones.h"

namespace jawari::host {

inline constexpr std::size_t midi_channel_count = 16;

struct InterpreterSettings {
    int guitar_channel = -1;  ///< 0 to 15: plays guitar_string[0], the next channel guitar_string[1], ...;
                              ///< -1: no guitar mode
    int guitar_strings = 0;   ///< channels of guitar mode
    std::array<int, midi_channel_count> guitar_string{};  ///< string of the instrument for each of them
    double bend_range_semitones = 2;  ///< of channels outside MPE zones until RPN 0 says otherwise, 0 to 96
    MidiMap map = default_midi_map();
};

/// What data entry speaks to.
enum class DataTarget { None, Registered, NonRegistered };

struct MidiChannel {
    int bend = 0x2000;                 ///< 14 bits
    double bend_range_semitones = 2;   ///< RPN 0
    double fine_tuning_semitones = 0;  ///< RPN 1, -1 to 1
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
};

struct MidiInterpreter {
    InterpreterSettings settings;
    MpeZones zones;
    std::array<MidiChannel, midi_channel_count> channels;
};

/// A program change: the host finds the preset.
struct ProgramRequest {
    bool asked = false;
    int channel = 0;  ///< 0 to 15
    int bank = 0;     ///< controllers 0 and 32: 128 MSB + LSB
    int program = 0;  ///< 0 to 127
};

/// What one message comes to.
struct MidiActions {
    /// Most: a reset of a whole zone, 16 channels with most_bindings_per_source bindings of two controllers.
    std::array<InstrumentEvent, 256> events{};
    std::size_t count = 0;
    ProgramRequest program;
};

/// The most events that one message comes to.
inline constexpr std::size_t most_events_per_message = std::tuple_size_v<decltype(MidiActions::events)>;

MidiInterpreter make_interpreter(const InterpreterSettings& settings);

/// Replaces `actions`. The events' frames are not set. Messages with bytes out of range come to nothing.
void interpret(MidiInterpreter& interpreter, const ChannelMessage& message,
               MidiActions& actions) JAWARI_REALTIME;

/// The channel whose instrument plays this channel's notes: its zone's manager; the guitar's first channel;
/// or the channel itself.
int part_channel(const MidiInterpreter& interpreter, int channel) JAWARI_REALTIME;

}  // namespace jawari::host
