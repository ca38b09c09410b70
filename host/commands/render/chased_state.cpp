#include "commands/render/chased_state.h"

#include <algorithm>
#include <numeric>

namespace jawari::host {

namespace {

bool is_setting(const InstrumentEvent& event) {
    switch (event.type) {
        case InstrumentEventType::Bend:
        case InstrumentEventType::Pressure:
            return event.key == every_key;
        case InstrumentEventType::Timbre:
        case InstrumentEventType::Sustain:
        case InstrumentEventType::SoftPedal:
        case InstrumentEventType::SetParameter:
            return true;
        default:
            return false;
    }
}

/// Whether nothing is left of `before` once `event` has come.
bool replaces(const InstrumentEvent& event, const InstrumentEvent& before) {
    const bool parameter = before.type == InstrumentEventType::SetParameter;
    if (event.type == InstrumentEventType::ResetControllers)
        return !parameter && before.channel == event.channel;
    if (before.type != event.type || (parameter && before.parameter != event.parameter)) return false;
    return before.channel == event.channel || event.channel == every_channel;
}

}  // namespace

void ChasedState::add(const InstrumentEvent& event) {
    const bool setting = is_setting(event);
    if (!setting && event.type != InstrumentEventType::ResetControllers) return;
    std::erase_if(events_, [&](const InstrumentEvent& before) { return replaces(event, before); });
    if (setting) events_.push_back(event);
}

std::uint64_t open_notes(const MidiInterpreter& interpreter) {
    std::uint64_t notes = 0;
    for (const MidiChannel& channel : interpreter.channels)
        if (!channel.unpitched)
            notes += std::accumulate(channel.open.begin(), channel.open.end(), std::uint64_t{0});
    return notes;
}

}  // namespace jawari::host
