// What overload costs in quality: strings change their quality level, a few in each block.
#include <algorithm>

#include "jawari/instrument/qualities.h"
#include "jawari/scene/cost.h"
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

/// A note that began below full quality keeps its level while the overload allows no more to what nobody
/// holds.
std::size_t wanted_level(OverloadLevel overload, bool held, std::size_t now, std::size_t lowest) {
    return std::clamp(now, quality_level_at(overload, held, lowest),
                      quality_level_at(overload, false, lowest));
}

/// Of the note in a block, at a quality level: a string that is struck has contacts as one that is pressed on
/// its obstacles.
double work_of(const InstrumentModel& model, const ExpectedNote& note, std::size_t level,
               std::size_t frames) {
    const InstrumentStringModel& string =
        level == 0 ? model.strings[note.string] : model.lower[level - 1][note.string];
    return static_cast<double>(frames) * frame_cost(string.stopped[note.fret].string).permanent_contact;
}

NoteWork work_of_all(const InstrumentModel& model, const InstrumentState& state,
                     std::span<const ExpectedNote> notes, std::size_t frames) {
    NoteWork work{};
    std::size_t before = 0;
    for (std::size_t overload = 0; overload < work.size(); ++overload) {
        const std::size_t level =
            quality_level_at(static_cast<OverloadLevel>(overload), false, model.lower.size());
        if (overload > 0 && level == before) {
            work[overload] = work[overload - 1];
            continue;
        }
        before = level;
        for (const ExpectedNote& note : notes)
            work[overload] +=
                work_of(model, note, std::max(level, quality_level(state, note.string)), frames);
    }
    return work;
}

}  // namespace

/// Before the block is rendered: the level at which its notes fit. Strings that they begin on change at once,
/// as many as there are. Returns how many of them sound.
std::size_t AudioThread::foresee_notes(std::size_t frames) JAWARI_REALTIME {
    note_work_ = 0;
    const auto sounding = stage_.sounding();
    if (!governor_.settings.enabled || frames == 0 || sounding.empty()) return 0;
    const InstrumentModel& model = sounding[0]->loaded->model;
    InstrumentState& state = sounding[0]->state;
    if (model.lower.empty()) return 0;
    const std::size_t count = expected_notes(model, state, stage_.events(), expected_);
    if (count == 0) return 0;
    const std::span notes(expected_.data(), count);
    const double duration_s = static_cast<double>(frames) / settings_.rate_hz;
    if (foresee(governor_, work_of_all(model, state, notes, frames), duration_s)) tell_level();
    std::size_t changes = 0;
    for (const ExpectedNote& note : notes) {
        const std::size_t level = quality_level_at(governor_.level, false, model.lower.size());
        if (quality_level(state, note.string) < level) {
            changes += sounding_voices(state, note.string) > 0 ? 1 : 0;
            change_quality(model, state, note.string, level);
        }
        note_work_ += work_of(model, note, quality_level(state, note.string), frames);
    }
    return changes;
}

/// `changes`: strings that changed in this block while they sound.
void AudioThread::adapt_quality(std::size_t changes) JAWARI_REALTIME {
    if (governor_.level == OverloadLevel::Full && lowered_ == 0) return;
    lowered_ = 0;
    const auto sounding = stage_.sounding();
    for (std::size_t i = 0; i < sounding.size(); ++i) {
        StagedInstrument& instrument = *sounding[i];
        const InstrumentModel& model = instrument.loaded->model;
        for (std::size_t s = 0; s < model.strings.size(); ++s) {
            InstrumentState& state = instrument.state;
            // What rings out is held by nobody.
            const bool held = i == 0 && is_held(model, state, s);
            const std::size_t level =
                wanted_level(governor_.level, held, quality_level(state, s), model.lower.size());
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
