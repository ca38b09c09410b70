// The audio thread's side.
#include <algorithm>
#include <cmath>

#include "jawari/denormals.h"
#include "midi/interpreter_expressions.h"
#include "plugin/core/plugin_core.h"

namespace jawari::host {

namespace {

constexpr double softest_velocity = 1.0 / 127;
constexpr double fast_release = 1;

template <class Sample>
void copy(const double* from, std::size_t frames, Sample* to) {
    for (std::size_t n = 0; n < frames; ++n) to[n] = static_cast<Sample>(from[n]);
}

bool is_key(const NoteAddress& note) {
    return note.channel >= 0 && note.channel < static_cast<int>(midi_channel_count) && note.key >= 0 &&
           note.key < static_cast<int>(midi_key_count);
}

/// To 0 to 1, whatever the host sends.
double share(double value) {
    return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0;
}

}  // namespace

// ---------------------------------------------------------------------------------------------- blocks

void PluginCore::reset() JAWARI_REALTIME {
    enter_waiting();
    stage_->reset();
    applied_ = neutral_parameters();
    notes_.clear();
    give_back();
}

void PluginCore::begin_block(const PluginOutput& output, std::size_t frames,
                             std::uint64_t skipped) JAWARI_REALTIME {
    output_ = output;
    with_strings_ =
        std::any_of(output.strings.begin(), output.strings.end(), [](auto* to) { return to; }) ||
        std::any_of(output.strings_64.begin(), output.strings_64.end(), [](auto* to) { return to; });
    frames_ = frames;
    rendered_ = 0;
    latest_ = 0;
    stage_->begin_block();
    stage_->skip_silence(skipped);
    enter_waiting();
    stage_->take_stage();
    follow_values();
}

void PluginCore::enter_waiting() JAWARI_REALTIME {
    if (next_.load(std::memory_order_relaxed) == nullptr) return;
    if (StagedInstrument* const next = next_.exchange(nullptr, std::memory_order_acq_rel)) stage_->call(next);
}

/// What the control thread has set, and after a reset everything.
void PluginCore::follow_values() JAWARI_REALTIME {
    for (const ParameterDeclaration& parameter : parameter_table()) {
        const double wanted = value(parameter.id);
        double& applied = applied_[static_cast<std::size_t>(parameter.id)];
        if (applied == wanted) continue;
        applied = wanted;
        place(0);
        stage_->set_parameter(parameter.id, wanted, 0);
    }
}

bool PluginCore::end_block() JAWARI_REALTIME {
    render_until(frames_);
    if (frames_ == 0) apply_rest();
    stage_->retire_silent();
    notes_.end_silent(sounding_keys(*stage_));
    return give_back();
}

bool PluginCore::give_back() JAWARI_REALTIME {
    bool any = false;
    while (StagedInstrument* const old = stage_->next_retired()) {
        retired_.push(old);
        any = true;
    }
    return any;
}

bool PluginCore::rests() const JAWARI_REALTIME {
    return next_.load(std::memory_order_relaxed) == nullptr && stage_->rests();
}

// ---------------------------------------------------------------------------------------------- sound

void PluginCore::render_until(std::size_t frame) JAWARI_REALTIME {
    const NoDenormals guard;
    std::array<double*, plugin_string_channels> strings{};
    for (std::size_t s = 0; s < strings.size(); ++s) strings[s] = string_sound_[s].data();
    StageOutput to{sound_[0].data(), sound_[1].data(), {}};
    if (with_strings_) to.strings = strings;
    while (rendered_ < frame) {
        const std::size_t count = std::min(chunk_frames, frame - rendered_);
        stage_->render(to, rendered_, count);
        copy_out(count);
        rendered_ += count;
    }
}

void PluginCore::copy_out(std::size_t frames) JAWARI_REALTIME {
    for (std::size_t side = 0; side < 2; ++side) {
        if (output_.main[side] != nullptr) copy(sound_[side].data(), frames, output_.main[side] + rendered_);
        if (output_.main_64[side] != nullptr)
            copy(sound_[side].data(), frames, output_.main_64[side] + rendered_);
    }
    if (!with_strings_) return;
    for (std::size_t s = 0; s < plugin_string_channels; ++s) {
        if (output_.strings[s] != nullptr)
            copy(string_sound_[s].data(), frames, output_.strings[s] + rendered_);
        if (output_.strings_64[s] != nullptr)
            copy(string_sound_[s].data(), frames, output_.strings_64[s] + rendered_);
    }
}

/// The events that no frame of the block has come to yet take effect before its next one.
void PluginCore::apply_rest() JAWARI_REALTIME {
    const NoDenormals guard;
    stage_->apply_without_sound(rendered_);
    stage_->begin_block();
}

/// The frame of the block at which the event counts; there is room for it afterwards.
std::size_t PluginCore::place(std::size_t frame) JAWARI_REALTIME {
    latest_ = std::max(latest_, std::min(frame, frames_ == 0 ? 0 : frames_ - 1));
    if (!stage_->has_room()) {
        render_until(latest_);
        apply_rest();
    }
    return latest_;
}

// ---------------------------------------------------------------------------------------------- events

void PluginCore::take(const ChannelMessage& message, std::size_t frame) JAWARI_REALTIME {
    stage_->take(message, place(frame));
}

void PluginCore::note_on(const NoteAddress& note, double velocity, std::size_t frame) JAWARI_REALTIME {
    if (!is_key(note)) return;
    const double struck = share(velocity);
    stage_->start_note(note.channel, note.key, struck > 0 ? struck : softest_velocity, place(frame));
    notes_.begin(note, sounding_key(stage_->interpreter(), note.channel, note.key));
}

void PluginCore::note_off(const NoteAddress& which, double release, std::size_t frame) JAWARI_REALTIME {
    bool found = false;
    notes_.for_each(which, [&](NoteRegister::Note& note) {
        // Notes without ids end in the order in which they began, as in MIDI.
        const bool is_later = found && note.address.note_id < 0 && which.key >= 0;
        if (!note.down || is_later) return;
        note.down = false;
        found = true;
        stage_->release_note(note.address.channel, note.address.key, share(release), place(frame));
    });
    // It may have begun as a MIDI message.
    if (!found && is_key(which)) stage_->release_note(which.channel, which.key, share(release), place(frame));
}

void PluginCore::choke(const NoteAddress& which, std::size_t frame) JAWARI_REALTIME {
    if (which.key >= 0 || which.note_id >= 0) {
        note_off(which, fast_release, frame);
        return;
    }
    constexpr std::uint8_t all_sound_off = 120;
    notes_.for_each(which, [](NoteRegister::Note& note) { note.down = false; });
    for (int channel = 0; channel < static_cast<int>(midi_channel_count); ++channel) {
        if (which.channel >= 0 && which.channel != channel) continue;
        stage_->take({static_cast<std::uint8_t>(0xB0 + channel), all_sound_off, 0}, place(frame));
    }
}

void PluginCore::express(PluginExpression expression, const NoteAddress& which, double value,
                         std::size_t frame) JAWARI_REALTIME {
    if (!std::isfinite(value)) return;
    notes_.for_each(which, [&](const NoteRegister::Note& note) {
        if (!note.down) return;
        const int channel = note.address.channel;
        const std::size_t at = place(frame);
        switch (expression) {
            case PluginExpression::Tuning:
                stage_->tune_note(channel, note.address.key, std::clamp(value, -96.0, 96.0), at);
                break;
            case PluginExpression::Pressure:
                stage_->add(press_note(0, note.sounds, share(value), channel), at);
                break;
            case PluginExpression::Brightness:
                stage_->add(set_timbre(0, share(value), channel), at);
                break;
            case PluginExpression::Volume:
                stage_->add(set_note_level(0, note.sounds, std::clamp(value, 0.0, most_note_level), channel),
                            at);
                break;
            case PluginExpression::Pan:
                stage_->add(set_note_pan(0, note.sounds, 2 * share(value) - 1, channel), at);
                break;
        }
    });
}

void PluginCore::set_parameter(ParameterId parameter, double value, std::size_t frame) JAWARI_REALTIME {
    const ParameterDeclaration& declared = declaration_of(parameter);
    if (!std::isfinite(value)) return;
    const double in_range = std::clamp(value, declared.low, declared.high);
    set_value(parameter, value);
    applied_[static_cast<std::size_t>(parameter)] = in_range;
    stage_->set_parameter(parameter, in_range, place(frame));
}

}  // namespace jawari::host
