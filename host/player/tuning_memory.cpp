#include "player/tuning_memory.h"

namespace jawari::host {

namespace {

void remember_value(TuningMemory& memory, int value) {
    if (memory.key >= 0) {
        memory.pitches[static_cast<std::size_t>(memory.program)][static_cast<std::size_t>(memory.key)] =
            memory.semitone * 16384 + value;
    } else if (memory.pitch_class >= 0) {
        for (std::size_t channel = 0; channel < TuningMemory::channels; ++channel)
            if ((memory.changed_channels >> channel & 1U) != 0)
                memory.offsets[channel][static_cast<std::size_t>(memory.pitch_class)] = value;
    }
}

}  // namespace

TuningMemory make_tuning_memory() {
    TuningMemory memory;
    for (auto& program : memory.pitches) program.fill(TuningMemory::never);
    for (auto& channel : memory.offsets) channel.fill(TuningMemory::never);
    return memory;
}

void remember_tuning(TuningMemory& memory, const ChannelMessage& message) JAWARI_REALTIME {
    if (message.data1 > 127 || message.data2 > 127) return;
    switch (static_cast<SystemKind>(message.status)) {
        case SystemKind::TuneProgram:
            memory.program = message.data1;
            memory.key = memory.pitch_class = -1;
            memory.changed_channels = 0;
            break;
        case SystemKind::TuneChannels:
            memory.changed_channels |= static_cast<unsigned>(message.data2) << (7U * (message.data1 % 3U));
            break;
        case SystemKind::TuneKey:
            memory.key = message.data1;
            memory.semitone = message.data2;
            memory.pitch_class = -1;
            break;
        case SystemKind::TuneClass:
            memory.pitch_class = message.data1 % 12;
            memory.key = -1;
            break;
        case SystemKind::TuneValue:
            remember_value(memory, message.data1 + 128 * message.data2);
            break;
        default:
            break;
    }
}

}  // namespace jawari::host
