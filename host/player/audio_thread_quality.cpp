// What overload costs in quality: strings change rungs, a few in each block.
#include <algorithm>

#include "jawari/instrument/qualities.h"
#include "player/audio_thread.h"

namespace jawari::host {

namespace {

/// Strings with motions that change in one block; each conversion costs about as much as a few frames.
constexpr std::size_t most_changes = 4;

bool is_held(const LiveInstrument& instrument, std::size_t s) {
    const std::size_t course = instrument.loaded->model.strings[s].course;
    return instrument.state.courses[course].held.active;
}

/// Rung for a string at the level; `lowest` is that of the instrument.
std::size_t rung_at(OverloadLevel level, bool held, std::size_t lowest) {
    const auto next = std::min<std::size_t>(1, lowest);
    switch (level) {
        case OverloadLevel::Full:
            return 0;
        case OverloadLevel::ReleasedLower:
            return held ? 0 : next;
        case OverloadLevel::ReleasedLowest:
            return held ? 0 : lowest;
        case OverloadLevel::AllLower:
            return held ? next : lowest;
        case OverloadLevel::AllLowest:
        case OverloadLevel::Fading:
            break;
    }
    return lowest;
}

}  // namespace

void Performer::adapt_quality() JAWARI_REALTIME {
    if (governor_.level == OverloadLevel::Full && lowered_ == 0) return;
    std::size_t changes = 0;
    lowered_ = 0;
    for (std::size_t i = 0; i < sounding_; ++i) {
        LiveInstrument& instrument = *stage_[i];
        const InstrumentModel& model = instrument.loaded->model;
        for (std::size_t s = 0; s < model.strings.size(); ++s) {
            InstrumentStringState& string = instrument.state.strings[s];
            // What rings out is held by nobody.
            const std::size_t rung =
                rung_at(governor_.level, i == 0 && is_held(instrument, s), model.lower.size());
            if (string.rung != rung && (string.busy == 0 || changes < most_changes)) {
                changes += string.busy > 0 ? 1 : 0;
                change_rung(model, instrument.state, s, rung);
            }
            lowered_ += string.rung > 0 ? 1 : 0;
        }
    }
    if (governor_.level != OverloadLevel::Fading) return;
    for (std::size_t i = 1; i < sounding_; ++i) stage_[i]->fading = true;
    if (sounding_ > 0) fade_oldest_released(stage_[0]->state);
}

}  // namespace jawari::host
