#include "plugin/core/note_register.h"

#include <algorithm>
#include <utility>

namespace jawari::host {

namespace {

void add_held(const CourseState& course, SoundingKeys& keys) {
    if (!course.held.active) return;
    auto& of_channel = keys[static_cast<std::size_t>(course.held.channel)];
    of_channel.set(static_cast<std::size_t>(course.held.key));
    for (std::size_t i = 0; i < course.below_count; ++i)
        of_channel.set(static_cast<std::size_t>(course.below[i]));
}

void add_string(const InstrumentStringModel& model, const InstrumentStringState& state, SoundingKeys& keys) {
    const auto add = [&](int channel, std::size_t fret) {
        const int key = model.stopped[fret].key;
        if (key >= 0) keys[static_cast<std::size_t>(channel)].set(static_cast<std::size_t>(key));
    };
    for (const Voice& voice : state.voices)
        if (voice.phase != VoicePhase::Idle) add(voice.channel, voice.fret);
    if (state.pending.active) add(state.pending.stroke.channel, state.pending.stroke.fret);
}

bool fits(int note, int which) {
    return which < 0 || note == which;
}

}  // namespace

SoundingKeys sounding_keys(const Stage& stage) JAWARI_REALTIME {
    SoundingKeys keys;
    for (const StagedInstrument* one : stage.sounding()) {
        for (const CourseState& course : one->state.courses) add_held(course, keys);
        for (std::size_t s = 0; s < one->state.strings.size(); ++s)
            add_string(one->loaded->model.strings[s], one->state.strings[s], keys);
    }
    return keys;
}

bool NoteRegister::is_meant(const NoteAddress& note, const NoteAddress& which) JAWARI_REALTIME {
    return fits(note.note_id, which.note_id) && fits(note.port, which.port) &&
           fits(note.channel, which.channel) && fits(note.key, which.key);
}

void NoteRegister::end(Note& note) JAWARI_REALTIME {
    if (note.ended) return;
    note.ended = true;
    if (ended_count_ < ended_.size()) ended_[ended_count_++] = note.address;
}

void NoteRegister::begin(const NoteAddress& address, int sounds) JAWARI_REALTIME {
    for (std::size_t i = 0; i < count_; ++i)
        if (notes_[i].address.channel == address.channel && notes_[i].address.key == address.key)
            end(notes_[i]);
    if (count_ == most_notes) {
        end(notes_[0]);
        std::move(notes_.begin() + 1, notes_.end(), notes_.begin());
        count_ -= 1;
    }
    notes_[count_++] = {address, sounds};
}

void NoteRegister::end_silent(const SoundingKeys& keys) JAWARI_REALTIME {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        Note& note = notes_[i];
        const auto channel = static_cast<std::size_t>(note.address.channel);
        if (!keys[channel][static_cast<std::size_t>(note.sounds)]) end(note);
        if (!note.ended || note.down) notes_[kept++] = note;
    }
    count_ = kept;
}

std::span<const NoteAddress> NoteRegister::take_ended() JAWARI_REALTIME {
    return {ended_.data(), std::exchange(ended_count_, 0)};
}

void NoteRegister::clear() JAWARI_REALTIME {
    count_ = 0;
    ended_count_ = 0;
}

}  // namespace jawari::host
