// Tunings of keys and of pitch classes (MIDI Tuning Standard) that messages have set so far, for recordings
// that begin later.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "jawari/realtime.h"
#include "midi/channel_message.h"
#include "midi/system_message.h"

namespace jawari::host {

struct TuningMemory {
    static constexpr std::size_t programs = 128, keys = 128, channels = 16, classes = 12;
    static constexpr std::int32_t never = -1;

    /// 16384 semitone + fraction that the key was given, by tuning program.
    std::array<std::array<std::int32_t, keys>, programs> pitches{};
    std::array<std::array<std::int32_t, classes>, channels> offsets{};  ///< 14 bits, by pitch class

    // The change under way:
    int program = 0, key = -1, semitone = 0, pitch_class = -1;
    unsigned changed_channels = 0;
};

TuningMemory make_tuning_memory();

/// Messages that tune nothing leave it alone.
void remember_tuning(TuningMemory& memory, const ChannelMessage& message) JAWARI_REALTIME;

/// At most this many messages say it all: a program's key takes two.
inline constexpr std::size_t most_recalled_tunings = TuningMemory::programs * (1 + 2 * TuningMemory::keys) +
                                                     TuningMemory::channels * (2 + 2 * TuningMemory::classes);

namespace detail {

template <class Kind, class Sink>
void tell_tuning(const Sink& sink, Kind kind, std::size_t data1, std::size_t data2) {
    sink(ChannelMessage{static_cast<std::uint8_t>(kind), static_cast<std::uint8_t>(data1),
                        static_cast<std::uint8_t>(data2)});
}

template <class Sink>
void recall_program(const TuningMemory& memory, std::size_t program, const Sink& sink) {
    bool begun = false;
    for (std::size_t key = 0; key < TuningMemory::keys; ++key) {
        const std::int32_t pitch = memory.pitches[program][key];
        if (pitch == TuningMemory::never) continue;
        if (!begun) tell_tuning(sink, SystemKind::TuneProgram, program, 0);
        begun = true;
        const auto value = static_cast<std::size_t>(pitch);
        tell_tuning(sink, SystemKind::TuneKey, key, value / 16384);
        tell_tuning(sink, SystemKind::TuneValue, value % 128, value / 128 % 128);
    }
}

template <class Sink>
void recall_octave(const TuningMemory& memory, std::size_t channel, const Sink& sink) {
    bool begun = false;
    for (std::size_t pitch_class = 0; pitch_class < TuningMemory::classes; ++pitch_class) {
        const std::int32_t offset = memory.offsets[channel][pitch_class];
        if (offset == TuningMemory::never) continue;
        if (!begun) {
            tell_tuning(sink, SystemKind::TuneProgram, 0, 0);
            tell_tuning(sink, SystemKind::TuneChannels, channel / 7, std::size_t{1} << (channel % 7));
        }
        begun = true;
        const auto value = static_cast<std::size_t>(offset);
        tell_tuning(sink, SystemKind::TuneClass, pitch_class, 0);
        tell_tuning(sink, SystemKind::TuneValue, value % 128, value / 128);
    }
}

}  // namespace detail

/// Calls sink(message): a change for each program, and one for each channel.
template <class Sink>
void recall_tunings(const TuningMemory& memory, const Sink& sink) {
    for (std::size_t program = 0; program < TuningMemory::programs; ++program)
        detail::recall_program(memory, program, sink);
    for (std::size_t channel = 0; channel < TuningMemory::channels; ++channel)
        detail::recall_octave(memory, channel, sink);
}

}  // namespace jawari::host
