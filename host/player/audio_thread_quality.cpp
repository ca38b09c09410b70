// What overload costs in quality: strings change their quality level, a few in each block.
#include <algorithm>

#include "jawari/instrument/qualities.h"
#include "player/audio_thread.h"

namespace jawari::host {

namespace {

/// Sounding strings that change in one block; each conversion costs about as much as a few frames.
constexpr std::size_t most_changes = 4;

/// Quality level for a string under an overload; `lowest` is the last of the instrument's.
std::size_t quality_level_at(OverloadLevel level, bool held, std::size_t lowest) {
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

void AudioThread::adapt_quality() JAWARI_REALTIME {
    if (governor_.level == OverloadLevel::Full && lowered_ == 0) return;
    std::size_t changes = 0;
    lowered_ = 0;
    const auto sounding = stage_.sounding();
    for (std::size_t i = 0; i < sounding.size(); ++i) {
        StagedInstrument& instrument = *sounding[i];
        const InstrumentModel& model = instrument.loaded->model;
        for (std::size_t s = 0; s < model.strings.size(); ++s) {
            InstrumentState& state = instrument.state;
            // What rings out is held by nobody.
            const bool held = i == 0 && is_held(model, state, s);
            const std::size_t level = quality_level_at(governor_.level, held, model.lower.size());
            const bool sounds = sounding_voices(state, s) > 0;
            if (quality_level(state, s) != level && (!sounds || changes < most_changes)) {
                changes += sounds ? 1 : 0;
                change_quality(model, state, s, level);
            }
            lowered_ += quality_level(state, s) > 0 ? 1 : 0;
        }
    }
    if (governor_.level != OverloadLevel::Fading) return;
    for (std::size_t i = 1; i < sounding.size(); ++i) sounding[i]->fading = true;
    if (!sounding.empty()) fade_oldest_released(sounding[0]->state);
}

}  // namespace jawari::host
