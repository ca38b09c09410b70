// Messages to the whole instrument: General MIDI, GS and XG, master volume and tuning, the MIDI Tuning
// Standard. System exclusive messages become messages of three bytes, so that queues and the audio thread
// need nothing else (docs/formats/midi.md, "System exclusive messages").
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "midi/channel_message.h"

namespace jawari::host {

/// Status byte of a ChannelMessage that is for all channels. Inside this program only: on a wire these bytes
/// mean other things, and files hold them as private_exclusive().
enum class SystemKind : std::uint8_t {
    Reset = 0xF1,         ///< data1: SoundMode
    MasterVolume = 0xF2,  ///< data1 + 128 data2
    MasterFine = 0xF3,    ///< data1 + 128 data2: -1 to 1 semitone, 8192 is none
    MasterCoarse = 0xF4,  ///< data1: semitones + 64
    Rhythm = 0xF5,        ///< data1: channel; data2: 1 for drums
    TuneProgram = 0xF6,  ///< data1: tuning program; data2: 1 if sounding notes follow. Begins a tuning change
    TuneChannels = 0xF7,  ///< data1: 0 to 2; data2: bits of channels 7 data1 to 7 data1 + 6 (of octaves)
    TuneKey = 0xF8,       ///< data1: key; data2: semitone that it sounds at, before TuneValue
    TuneClass = 0xF9,     ///< data1: pitch class, 0 is C, before TuneValue
    TuneValue = 0xFA      ///< data1 + 128 data2: fraction of a semitone, or of an octave's class -1 to 1
};

/// Whose rules hold for banks and drums.
enum class SoundMode : std::uint8_t { Plain, Gm, Gm2, Gs, Xg };

inline constexpr std::uint8_t first_system_kind = 0xF1;
inline constexpr std::uint8_t last_system_kind = 0xFA;

constexpr bool is_system(const ChannelMessage& message) {
    return message.status >= first_system_kind && message.status <= last_system_kind;
}

/// What a system exclusive message comes to.
struct DecodedExclusive {
    std::vector<ChannelMessage> messages;  ///< of SystemKind, in order; empty: it is ignored
    std::string name;                      ///< of its kind, `GS reverb`
};

/// `bytes`: without F0 and F7.
DecodedExclusive decode_exclusive(std::span<const std::uint8_t> bytes);

/// The body of a system exclusive message (7D: for private use) that decode_exclusive() turns into `message`
/// again: how recordings hold it.
std::vector<std::uint8_t> private_exclusive(const ChannelMessage& message);

}  // namespace jawari::host
