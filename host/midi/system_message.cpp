#include "midi/system_message.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace jawari::host {

namespace {

using Bytes = std::span<const std::uint8_t>;
using Messages = std::vector<ChannelMessage>;

// Manufacturers
constexpr std::uint8_t roland = 0x41, yamaha = 0x43, for_private_use = 0x7D, non_real_time = 0x7E,
                       real_time = 0x7F;
constexpr std::array<std::uint8_t, 2> private_mark{'J', 'W'};
constexpr std::size_t midi_keys_of_dump = 128;
constexpr std::size_t name_of_dump = 16;

ChannelMessage system(SystemKind kind, int data1, int data2 = 0) {
    return {static_cast<std::uint8_t>(kind), static_cast<std::uint8_t>(data1 & 0x7F),
            static_cast<std::uint8_t>(data2 & 0x7F)};
}

ChannelMessage fourteen_bits(SystemKind kind, int value) {
    const int kept = std::clamp(value, 0, 16383);
    return system(kind, kept % 128, kept / 128);
}

ChannelMessage reset_to(SoundMode mode) {
    return system(SystemKind::Reset, static_cast<int>(mode));
}

/// Seven bits over the range of fourteen.
ChannelMessage volume_of(std::uint8_t value) {
    return fourteen_bits(SystemKind::MasterVolume, static_cast<int>(std::lround(value * 16383.0 / 127)));
}

/// GS and XG: four halves of bytes, 0.1 cents from 0x400.
ChannelMessage tune_of_nibbles(Bytes data) {
    int value = 0;
    for (const std::uint8_t nibble : data.first(4)) value = value * 16 + (nibble & 0x0F);
    return fourteen_bits(SystemKind::MasterFine,
                         static_cast<int>(std::lround(8192 * (1 + (value - 0x400) / 1000.0))));
}

void tune_key(Messages& messages, int key, Bytes pitch) {
    constexpr int no_change = 0x7F;
    if (pitch[0] == no_change && pitch[1] == no_change && pitch[2] == no_change) return;
    messages.push_back(system(SystemKind::TuneKey, key, pitch[0]));
    messages.push_back(system(SystemKind::TuneValue, pitch[2], pitch[1]));
}

/// 08 02 tt n {key, semitone, fraction, fraction}, and 08 07 with a bank before tt.
Messages single_notes(Bytes data, bool now) {
    Messages messages;
    if (data.size() < 2 || data.size() < 2 + std::size_t{4} * data[1]) return messages;
    messages.push_back(system(SystemKind::TuneProgram, data[0], now ? 1 : 0));
    for (std::size_t i = 0; i < data[1]; ++i) {
        const Bytes change = data.subspan(2 + 4 * i, 4);
        tune_key(messages, change[0], change.subspan(1));
    }
    return messages;
}

/// 08 01 tt name {semitone, fraction, fraction}: every key.
Messages bulk_dump(Bytes data) {
    Messages messages;
    if (data.size() < 1 + name_of_dump + 3 * midi_keys_of_dump) return messages;
    messages.push_back(system(SystemKind::TuneProgram, data[0], 0));
    for (std::size_t key = 0; key < midi_keys_of_dump; ++key)
        tune_key(messages, static_cast<int>(key), data.subspan(1 + name_of_dump + 3 * key, 3));
    return messages;
}

/// 08 08 and 08 09: three bytes of channels, 16 first; then twelve pitch classes from C, of one byte (cents
/// from 64) or two (of 8192).
Messages octave_tuning(Bytes data, std::size_t bytes, bool now) {
    Messages messages;
    if (data.size() < 3 + 12 * bytes) return messages;
    messages.push_back(system(SystemKind::TuneProgram, 0, now ? 1 : 0));
    for (int group = 0; group < 3; ++group)
        messages.push_back(
            system(SystemKind::TuneChannels, group, data[static_cast<std::size_t>(2 - group)]));
    for (std::size_t i = 0; i < 12; ++i) {
        const Bytes value = data.subspan(3 + bytes * i, bytes);
        messages.push_back(system(SystemKind::TuneClass, static_cast<int>(i)));
        const int fine = bytes == 1 ? static_cast<int>(std::lround(8192 + (value[0] - 64) * 81.92))
                                    : value[0] * 128 + value[1];
        messages.push_back(fourteen_bits(SystemKind::TuneValue, fine));
    }
    return messages;
}

DecodedExclusive tuning_standard(std::uint8_t kind, Bytes data, bool now) {
    switch (kind) {
        case 0x01:
            return {bulk_dump(data), "MIDI tuning, dump"};
        case 0x02:
            return {single_notes(data, now), "MIDI tuning, notes"};
        case 0x07:  // its first byte is a bank
            return {single_notes(data.empty() ? data : data.subspan(1), now), "MIDI tuning, notes"};
        case 0x08:
            return {octave_tuning(data, 1, now), "MIDI tuning, octave"};
        case 0x09:
            return {octave_tuning(data, 2, now), "MIDI tuning, octave"};
        default:
            return {{}, "MIDI tuning"};
    }
}

DecodedExclusive device_control(std::uint8_t kind, Bytes data) {
    if (data.size() < 2) return {{}, "device control"};
    const int value = data[0] + 128 * data[1];
    switch (kind) {
        case 0x01:
            return {{fourteen_bits(SystemKind::MasterVolume, value)}, "master volume"};
        case 0x02:
            return {{}, "master balance"};
        case 0x03:
            return {{fourteen_bits(SystemKind::MasterFine, value)}, "master fine tuning"};
        case 0x04:
            return {{system(SystemKind::MasterCoarse, data[1])}, "master coarse tuning"};
        case 0x05:
            return {{}, "reverb or chorus (GM2)"};
        default:
            return {{}, "device control"};
    }
}

/// 7E and 7F, a device, two bytes of kind.
DecodedExclusive universal(Bytes bytes) {
    const bool now = bytes[0] == real_time;
    if (bytes.size() < 4) return {{}, "universal message"};
    const std::uint8_t kind = bytes[3];
    const Bytes data = bytes.subspan(4);
    if (bytes[2] == 0x08) return tuning_standard(kind, data, now);
    if (now && bytes[2] == 0x04) return device_control(kind, data);
    if (now && bytes[2] == 0x01) return {{}, "MIDI time code"};
    if (now && (bytes[2] == 0x06 || bytes[2] == 0x07)) return {{}, "MIDI machine control"};
    if (now && bytes[2] == 0x09) return {{}, "controller destinations (GM2)"};
    if (!now && bytes[2] == 0x09) {
        switch (kind) {
            case 0x01:
                return {{reset_to(SoundMode::Gm)}, "General MIDI on"};
            case 0x02:
                return {{reset_to(SoundMode::Plain)}, "General MIDI off"};
            case 0x03:
                return {{reset_to(SoundMode::Gm2)}, "General MIDI 2 on"};
            default:
                break;
        }
    }
    if (!now && bytes[2] == 0x06) return {{}, "identity request"};
    return {{}, "universal message"};
}

/// The part of GS that 40 1x addresses: 0 is channel 10, 1 to 9 are 1 to 9, 10 to 15 are 11 to 16.
int channel_of_part(int part) {
    if (part == 0) return 9;
    return part <= 9 ? part - 1 : part;
}

ChannelMessage control(int channel, int controller, int value) {
    return {static_cast<std::uint8_t>(0xB0 + channel), static_cast<std::uint8_t>(controller),
            static_cast<std::uint8_t>(value)};
}

ChannelMessage program(int channel, int number) {
    return {static_cast<std::uint8_t>(0xC0 + channel), static_cast<std::uint8_t>(number), 0};
}

/// 40 1x: what controllers and program changes say as well.
DecodedExclusive gs_part(int channel, int address, Bytes data) {
    switch (address) {
        case 0x00:
            if (data.size() < 3) return {{}, "GS part"};  // two of data, a checksum
            return {{control(channel, 0, data[0]), program(channel, data[1])}, "GS tone"};
        case 0x15:
            return {{system(SystemKind::Rhythm, channel, data[0] > 0 ? 1 : 0)}, "GS rhythm part"};
        case 0x19:
            return {{control(channel, 7, data[0])}, "GS part level"};
        case 0x1C:
            if (data[0] == 0) return {{}, "GS random pan"};
            return {{control(channel, 10, data[0])}, "GS part pan"};
        default:
            return {{}, "GS part"};
    }
}

/// 08 nn: the same of XG.
DecodedExclusive xg_part(int channel, int address, std::uint8_t value) {
    switch (address) {
        case 0x01:
            return {{control(channel, 0, value)}, "XG part bank"};
        case 0x02:
            return {{control(channel, 32, value)}, "XG part bank"};
        case 0x03:
            return {{program(channel, value)}, "XG part program"};
        case 0x07:
            return {{system(SystemKind::Rhythm, channel, value > 0 ? 1 : 0)}, "XG part mode"};
        case 0x0B:
            return {{control(channel, 7, value)}, "XG part volume"};
        case 0x0E:
            if (value == 0) return {{}, "XG random pan"};
            return {{control(channel, 10, value)}, "XG part pan"};
        default:
            return {{}, "XG part"};
    }
}

/// 41, device, 42 12, three bytes of address, data, checksum.
DecodedExclusive gs(Bytes bytes) {
    const auto is = [bytes](int high, int middle, int low) {
        return bytes[4] == high && bytes[5] == middle && bytes[6] == low;
    };
    const std::uint8_t value = bytes[7];
    const Bytes data = bytes.subspan(7);
    if (is(0x40, 0x00, 0x7F) || is(0x00, 0x00, 0x7F)) return {{reset_to(SoundMode::Gs)}, "GS reset"};
    if (is(0x40, 0x00, 0x04)) return {{volume_of(value)}, "GS master volume"};
    if (is(0x40, 0x00, 0x05)) return {{system(SystemKind::MasterCoarse, value)}, "GS master key shift"};
    if (is(0x40, 0x00, 0x00) && data.size() >= 4) return {{tune_of_nibbles(data)}, "GS master tuning"};
    if (bytes[4] == 0x40 && bytes[5] == 0x01 && bytes[6] >= 0x30 && bytes[6] < 0x38) return {{}, "GS reverb"};
    if (bytes[4] == 0x40 && bytes[5] == 0x01 && bytes[6] >= 0x38 && bytes[6] < 0x50) return {{}, "GS chorus"};
    if (bytes[4] == 0x40 && bytes[5] == 0x01) return {{}, "GS patch"};
    if (bytes[4] == 0x40 && (bytes[5] & 0xF0) == 0x10)
        return gs_part(channel_of_part(bytes[5] & 0x0F), bytes[6], data);
    if (bytes[4] == 0x41) return {{}, "GS drum set"};
    return {{}, "GS"};
}

/// 43, 1 and device, 4C, three bytes of address, data.
DecodedExclusive xg(Bytes bytes) {
    const auto is = [bytes](int high, int middle, int low) {
        return bytes[3] == high && bytes[4] == middle && bytes[5] == low;
    };
    const std::uint8_t value = bytes[6];
    const Bytes data = bytes.subspan(6);
    if (is(0x00, 0x00, 0x7E) || is(0x00, 0x00, 0x7F)) return {{reset_to(SoundMode::Xg)}, "XG on"};
    if (is(0x00, 0x00, 0x04)) return {{volume_of(value)}, "XG master volume"};
    if (is(0x00, 0x00, 0x06)) return {{system(SystemKind::MasterCoarse, value)}, "XG transposition"};
    if (is(0x00, 0x00, 0x00) && data.size() >= 4) return {{tune_of_nibbles(data)}, "XG master tuning"};
    if (bytes[3] == 0x02 || bytes[3] == 0x03) return {{}, "XG effects"};
    if (bytes[3] == 0x08 && bytes[4] < 16) return xg_part(bytes[4], bytes[5], value);
    if (bytes[3] == 0x08) return {{}, "XG part"};
    if (bytes[3] == 0x06 || bytes[3] == 0x07) return {{}, "XG display"};
    return {{}, "XG"};
}

DecodedExclusive private_use(Bytes bytes) {
    if (bytes.size() != 6 || bytes[1] != private_mark[0] || bytes[2] != private_mark[1])
        return {{}, "private message"};
    const ChannelMessage message{static_cast<std::uint8_t>(0x80 | bytes[3]), bytes[4], bytes[5]};
    if (!is_system(message)) return {{}, "private message"};
    return {{message}, "Jawari"};
}

}  // namespace

DecodedExclusive decode_exclusive(std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) return {{}, "empty message"};
    if (std::any_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte > 0x7F; }))
        return {{}, "message with bytes above 0x7F"};
    switch (bytes[0]) {
        case real_time:
        case non_real_time:
            return universal(bytes);
        case for_private_use:
            return private_use(bytes);
        case roland:
            if (bytes.size() >= 9 && bytes[2] == 0x42 && bytes[3] == 0x12) return gs(bytes);
            return {{}, bytes.size() > 2 && bytes[2] == 0x45 ? "Roland display" : "Roland"};
        case yamaha:
            if (bytes.size() >= 7 && (bytes[1] & 0xF0) == 0x10 && bytes[2] == 0x4C) return xg(bytes);
            return {{}, "Yamaha"};
        case 0x40:
            return {{}, "Kawai"};
        case 0x42:
            return {{}, "Korg"};
        case 0x44:
            return {{}, "Casio"};
        default:
            return {{}, "other manufacturers"};
    }
}

std::vector<std::uint8_t> private_exclusive(const ChannelMessage& message) {
    return {for_private_use, private_mark[0],
            private_mark[1], static_cast<std::uint8_t>(message.status & 0x7F),
            message.data1,   message.data2};
}

}  // namespace jawari::host
