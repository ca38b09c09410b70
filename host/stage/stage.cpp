#include "stage/stage.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>

#include "midi/interpreter_expressions.h"
#include "midi/interpreter_parameters.h"

namespace jawari::host {

namespace {

/// Of a block.
constexpr std::size_t most_events = 16384;
constexpr double gain_time_s = 0.01;
/// In which an instrument fades that is taken away while it sounds.
constexpr double stage_fade_s = 0.05;

}  // namespace

Stage::Stage(const StageSettings& settings)
    : settings_(settings),
      interpreter_(make_interpreter(settings.interpreter)),
      fresh_(interpreter_),
      watch_(settings.rate_hz),
      gain_(settings.gain),
      gain_target_(settings.gain) {
    events_.reserve(most_events);
    chunk_.reserve(most_events);
    gains_.assign(settings.most_frames, settings.gain);
    fadings_.assign(settings.most_frames, 1.0);
}

// ---------------------------------------------------------------------------------------------- events

const MidiActions& Stage::take(const ChannelMessage& message, std::size_t frame) JAWARI_REALTIME {
    interpret(interpreter_, message, actions_);
    add_actions(frame);
    return actions_;
}

void Stage::start_note(int channel, int key, double velocity, std::size_t frame) JAWARI_REALTIME {
    actions_.count = 0;
    host::start_note(interpreter_, channel, key, velocity, actions_);
    add_actions(frame);
}

void Stage::release_note(int channel, int key, double release, std::size_t frame) JAWARI_REALTIME {
    actions_.count = 0;
    host::release_note(interpreter_, channel, key, release, actions_);
    add_actions(frame);
}

void Stage::tune_note(int channel, int key, double semitones, std::size_t frame) JAWARI_REALTIME {
    actions_.count = 0;
    host::tune_note(interpreter_, channel, key, semitones, actions_);
    add_actions(frame);
}

void Stage::set_parameter(ParameterId parameter, double value, std::size_t frame) JAWARI_REALTIME {
    actions_.count = 0;
    host::set_parameter(interpreter_, parameter, value, actions_);
    add_actions(frame);
}

void Stage::add_actions(std::size_t frame) JAWARI_REALTIME {
    for (std::size_t i = 0; i < actions_.count; ++i) add(actions_.events[i], frame);
}

void Stage::take_window_events() JAWARI_REALTIME {
    if (settings_.link == nullptr) return;
    InstrumentEvent event;
    while (room() > 0 && settings_.link->next_event(event)) add(event, 0);
}

void Stage::add(InstrumentEvent event, std::size_t frame) JAWARI_REALTIME {
    // As make_score(): in guitar mode, other channels have no strings.
    const bool guitar = interpreter_.settings.guitar_channel >= 0;
    if (guitar && event.type == InstrumentEventType::NoteOn && event.string < 0) {
        unplayed_notes_ += 1;
        return;
    }
    if (events_.size() == events_.capacity()) return;
    event.frame = frame;
    events_.push_back(event);
}

// ---------------------------------------------------------------------------------------------- sound

void Stage::render(const StageOutput& output, std::size_t begin, std::size_t frames) JAWARI_REALTIME {
    const bool watched = settings_.link != nullptr && settings_.link->is_open();
    if (watched_ && !watched)
        for (StagedInstrument* one : sounding()) watch_.close(one);
    watched_ = watched;
    if (watched && sounding_ > 0)
        render_watched(output, begin, frames);
    else
        render_part(output, begin, frames);
}

/// In parts, between which strings are looked at: the sound is the same.
void Stage::render_watched(const StageOutput& output, std::size_t begin, std::size_t frames) JAWARI_REALTIME {
    using Clock = std::chrono::steady_clock;
    const auto started = Clock::now();
    std::array<double*, most_string_channels> strings{};
    const std::size_t channels = std::min(output.strings.size(), strings.size());
    for (std::size_t done = 0; done < frames;) {
        const std::size_t count = std::min(frames - done, watch_.frames_to_look(frame_));
        StageOutput part{output.left + done, output.right + done, {}};
        for (std::size_t s = 0; s < channels; ++s) strings[s] = output.strings[s] + done;
        part.strings = {strings.data(), channels};
        render_part(part, begin + done, count);
        watch_.hear(part.left, part.right, count);
        done += count;
        watch_.look(*stage_[0], frame_);
        if (done < frames) watch_.publish(*settings_.link, *stage_[0], frame_);
    }
    watch_.add_load(frames, std::chrono::duration<double>(Clock::now() - started).count());
    watch_.publish(*settings_.link, *stage_[0], frame_);
}

void Stage::render_part(const StageOutput& output, std::size_t begin, std::size_t frames) JAWARI_REALTIME {
    std::fill(output.left, output.left + frames, 0.0);
    std::fill(output.right, output.right + frames, 0.0);
    for (double* const string : output.strings) std::fill(string, string + frames, 0.0);
    follow_gain(frames);
    for (std::size_t i = 0; i < sounding_; ++i) render_one(*stage_[i], i == 0, begin, frames, output);
    frame_ += frames;
}

void Stage::apply_without_sound(std::size_t begin) JAWARI_REALTIME {
    constexpr std::size_t all = static_cast<std::size_t>(-1);
    for (std::size_t i = 0; i < sounding_; ++i) {
        select_events(i == 0, begin, all);
        render_instrument(stage_[i]->loaded->model, stage_[i]->state, chunk_, InstrumentOutput{}, 0);
    }
}

void Stage::set_gain(double gain) JAWARI_REALTIME {
    gain_target_ = gain;
    gain_rate_ = (gain_target_ - gain_) / (gain_time_s * settings_.rate_hz);
}

void Stage::follow_gain(std::size_t frames) JAWARI_REALTIME {
    for (std::size_t n = 0; n < frames; ++n) {
        if (gain_ != gain_target_) {
            const double left = gain_target_ - gain_;
            gain_ = std::abs(left) <= std::abs(gain_rate_) ? gain_target_ : gain_ + gain_rate_;
        }
        gains_[n] = gain_;
    }
}

/// Those of the part of the block, with frames in it. What rings out begins no notes.
void Stage::select_events(bool plays, std::size_t begin, std::size_t end) JAWARI_REALTIME {
    chunk_.clear();
    for (const InstrumentEvent& event : events_) {
        if (event.frame < begin || event.frame >= end) continue;
        if (!plays && event.type == InstrumentEventType::NoteOn) continue;
        chunk_.push_back(event);
        chunk_.back().frame -= begin;
    }
}

void Stage::render_one(StagedInstrument& instrument, bool plays, std::size_t begin, std::size_t frames,
                       const StageOutput& output) JAWARI_REALTIME {
    select_events(plays, begin, begin + frames);
    const bool with_strings = !output.strings.empty();
    InstrumentOutput place{instrument.left.data(), instrument.right.data(), {}};
    if (with_strings) place.strings = instrument.string_places;
    render_instrument(instrument.loaded->model, instrument.state, chunk_, place, frames);
    if (instrument.fading) fade(instrument, frames);
    for (std::size_t n = 0; n < frames; ++n) {
        output.left[n] += gains_[n] * instrument.left[n];
        output.right[n] += gains_[n] * instrument.right[n];
    }
    if (with_strings) add_strings(instrument, frames, output.strings);
    if (!plays) instrument.ring_frames += frames;
}

void Stage::add_strings(const StagedInstrument& instrument, std::size_t frames,
                        std::span<double* const> strings) JAWARI_REALTIME {
    for (std::size_t s = 0; s < instrument.strings.size(); ++s) {
        double* const sum = strings[std::min(s, strings.size() - 1)];
        const std::vector<double>& signal = instrument.strings[s];
        for (std::size_t n = 0; n < frames; ++n)
            sum[n] += gains_[n] * (instrument.fading ? fadings_[n] * signal[n] : signal[n]);
    }
}

double Stage::fade_frames() const JAWARI_REALTIME {
    return std::ceil(stage_fade_s * settings_.rate_hz);
}

void Stage::fade(StagedInstrument& instrument, std::size_t frames) JAWARI_REALTIME {
    for (std::size_t n = 0; n < frames; ++n) {
        const double gone = std::min(1.0, static_cast<double>(instrument.fade_frame) / fade_frames());
        fadings_[n] = 0.5 * (1 + std::cos(std::numbers::pi * gone));
        instrument.left[n] *= fadings_[n];
        instrument.right[n] *= fadings_[n];
        instrument.fade_frame += 1;
    }
}

}  // namespace jawari::host
