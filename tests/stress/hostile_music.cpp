#include "hostile_music.h"

#include <algorithm>
#include <limits>

namespace jawari::stress {

HostileMusic::HostileMusic(const InstrumentModel& model, std::uint64_t seed)
    : dice_(seed ^ 0x5EEDCAFE12345678ULL),
      strings_(model.strings.size()),
      lower_qualities_(model.lower.size()) {
    for (const InstrumentStringModel& string : model.strings) {
        for (const StoppedStringModel& stopped : string.stopped) {
            if (stopped.key >= 0) keys_.push_back(stopped.key);
        }
    }
    most_events_ = dice_.spread_whole(1, 64);
    channels_ = dice_.chance(0.5) ? 1 : 16;
    bend_range_ = dice_.pick({0, 2, 48, 48, 96});
    notes_ = dice_.uniform(0.1, 0.7);
    bends_ = dice_.uniform(0, 0.3);
    parameters_ = dice_.uniform(0, 0.5);
}

int HostileMusic::key() {
    if (keys_.empty() || dice_.chance(0.02)) return static_cast<int>(dice_.whole(0, 127));
    return keys_[dice_.whole(0, keys_.size() - 1)];
}

InstrumentEvent HostileMusic::note() {
    InstrumentEvent event;
    event.type = dice_.chance(0.65) ? InstrumentEventType::NoteOn : InstrumentEventType::NoteOff;
    event.key = key();
    event.value = dice_.chance(0.2) ? 1.0 : dice_.unit();
    if (dice_.chance(0.1)) event.string = static_cast<int>(dice_.whole(0, strings_ - 1));
    return event;
}

InstrumentEvent HostileMusic::bend() {
    InstrumentEvent event;
    const bool pressure = dice_.chance(0.3);
    event.type = pressure ? InstrumentEventType::Pressure : InstrumentEventType::Bend;
    event.key = dice_.chance(0.5) ? -1 : key();
    event.value = pressure ? dice_.unit() : dice_.uniform(-bend_range_, bend_range_);
    return event;
}

InstrumentEvent HostileMusic::parameter() {
    InstrumentEvent event;
    event.type = InstrumentEventType::SetParameter;
    const ParameterDeclaration& declared = parameter_table()[dice_.whole(0, parameter_count - 1)];
    event.parameter = declared.id;
    event.value = parameter_value(declared, dice_.chance(0.2) ? dice_.pick({0, 1}) : dice_.unit());
    return event;
}

/// Out of range: to be ignored.
InstrumentEvent HostileMusic::nonsense() {
    InstrumentEvent event = dice_.chance(0.5) ? note() : parameter();
    switch (dice_.whole(0, 3)) {
        case 0:
            event.value = std::numeric_limits<double>::quiet_NaN();
            break;
        case 1:
            event.value = dice_.pick({1e300, -1e300, -1, 1000});
            break;
        case 2:
            event.key = static_cast<int>(dice_.whole(0, 1000)) - 500;
            break;
        default:
            event.parameter = static_cast<ParameterId>(dice_.whole(parameter_count, 1000));
    }
    return event;
}

InstrumentEvent HostileMusic::event() {
    const double choice = dice_.unit() * (notes_ + bends_ + parameters_ + 0.1);
    if (dice_.chance(0.01)) return nonsense();
    if (choice < notes_) return note();
    if (choice < notes_ + bends_) return bend();
    if (choice < notes_ + bends_ + parameters_) return parameter();
    static constexpr InstrumentEventType others[] = {
        InstrumentEventType::Timbre,           InstrumentEventType::Sustain,
        InstrumentEventType::Sustain,          InstrumentEventType::Sustain,
        InstrumentEventType::SoftPedal,        InstrumentEventType::AllNotesOff,
        InstrumentEventType::ResetControllers, InstrumentEventType::AllSoundOff};
    InstrumentEvent event;
    event.type = others[dice_.whole(0, 7)];
    event.value = dice_.chance(0.5) ? dice_.pick({0, 1}) : dice_.unit();
    return event;
}

MusicBlock HostileMusic::next() {
    MusicBlock block;
    block.frames = dice_.spread_whole(1, 512);
    if (lower_qualities_ > 0 && dice_.chance(0.3))
        block.quality_changes.push_back({dice_.whole(0, strings_ - 1), dice_.whole(0, lower_qualities_)});
    for (std::size_t n = dice_.whole(0, most_events_); n > 0; --n) {
        InstrumentEvent next = event();
        next.frame = dice_.whole(0, block.frames - 1);
        next.channel = static_cast<int>(dice_.whole(0, static_cast<std::size_t>(channels_) - 1));
        if (next.type == InstrumentEventType::SetParameter && dice_.chance(0.3)) next.channel = -1;
        block.events.push_back(next);
    }
    std::stable_sort(block.events.begin(), block.events.end(),
                     [](const InstrumentEvent& a, const InstrumentEvent& b) { return a.frame < b.frame; });
    return block;
}

}  // namespace jawari::stress
