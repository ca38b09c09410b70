// Commands, and which instruments sound.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "player/audio_thread.h"

namespace jawari::host {

namespace {

/// In which an instrument fades that is taken away while it sounds.
constexpr double stage_fade_s = 0.05;
constexpr double gain_time_s = 0.01;

}  // namespace

void AudioThread::obey_commands() JAWARI_REALTIME {
    while (links_.commands.read_available() > 0 && obey(links_.commands.front())) links_.commands.pop();
    take_stage();
}

/// False if it has to wait.
bool AudioThread::obey(const LiveCommand& command) JAWARI_REALTIME {
    switch (command.kind) {
        case LiveCommand::Kind::SetParameter:
            if (events_.size() == events_.capacity()) return false;
            add_event(set_parameter(0, command.parameter, command.value, command.channel), 0);
            return true;
        case LiveCommand::Kind::SetGain:
            gain_target_ = command.value;
            gain_rate_ = (gain_target_ - gain_) / (gain_time_s * settings_.rate_hz);
            return true;
        case LiveCommand::Kind::Panic:
            return panic();
        case LiveCommand::Kind::Publish:
            call_on_stage(command.instrument);
            return true;
        case LiveCommand::Kind::StartCapture:
            if (capture_ != nullptr) end_capture();
            start_capture(command.capture);
            return true;
        case LiveCommand::Kind::StopCapture:
            stop_capture();
            return true;
    }
    return true;
}

/// As messages, so that a recording has them.
bool AudioThread::panic() JAWARI_REALTIME {
    constexpr std::uint8_t all_sound_off = 120;
    constexpr std::uint8_t reset_all_controllers = 121;
    // Without notes a reset of a channel comes to less than its bindings of all controllers.
    constexpr std::size_t most_events_of_panic = 2 * midi_channel_count * 4 * most_bindings;
    if (events_.size() + most_events_of_panic > events_.capacity()) return false;
    for (std::uint8_t channel = 0; channel < midi_channel_count; ++channel) {
        const auto status = static_cast<std::uint8_t>(0xB0 + channel);
        apply({status, all_sound_off, 0}, 0);
        apply({status, reset_all_controllers, 0}, 0);
    }
    return true;
}

// ---------------------------------------------------------------------------------------------- instruments

/// Takes the stage at the next occasion. Another one that still waits for it will never be heard.
void AudioThread::call_on_stage(LiveInstrument* instrument) JAWARI_REALTIME {
    if (waiting_ != nullptr) links_.retired.push(waiting_);
    waiting_ = instrument;
}

/// While as many instruments sound as may, the oldest fades first.
void AudioThread::take_stage() JAWARI_REALTIME {
    if (waiting_ == nullptr) return;
    if (sounding_ == most_sounding) {
        stage_[sounding_ - 1]->fading = true;
        return;
    }
    if (sounding_ > 0) inherit_controls(stage_[0]->state, waiting_->state);
    set_clock(waiting_->state, frame_ - clock_origin_);
    std::move_backward(stage_.begin(), stage_.begin() + static_cast<std::ptrdiff_t>(sounding_),
                       stage_.begin() + static_cast<std::ptrdiff_t>(sounding_) + 1);
    stage_[0] = std::exchange(waiting_, nullptr);
    sounding_ += 1;
}

void AudioThread::fade(LiveInstrument& instrument, std::size_t frames) JAWARI_REALTIME {
    for (std::size_t n = 0; n < frames; ++n) {
        const double gone = std::min(1.0, static_cast<double>(instrument.fade_frame) / fade_frames());
        const double gain = 0.5 * (1 + std::cos(std::numbers::pi * gone));
        instrument.left[n] *= gain;
        instrument.right[n] *= gain;
        instrument.fade_frame += 1;
    }
}

double AudioThread::fade_frames() const JAWARI_REALTIME {
    return std::ceil(stage_fade_s * settings_.rate_hz);
}

void AudioThread::retire_silent() JAWARI_REALTIME {
    std::size_t kept = std::min<std::size_t>(sounding_, 1);
    for (std::size_t i = 1; i < sounding_; ++i) {
        LiveInstrument& old = *stage_[i];
        if (static_cast<double>(old.ring_frames) > settings_.ring_out_s * settings_.rate_hz)
            old.fading = true;
        const bool faded = old.fading && static_cast<double>(old.fade_frame) > fade_frames();
        if (faded || at_rest(old.state)) {
            retired_counters_ += old.state.counters;
            retired_nonfinite_ += old.nonfinite_resets;
            links_.retired.push(&old);
        } else {
            stage_[kept++] = &old;
        }
    }
    sounding_ = kept;
}

void AudioThread::give_back_all() JAWARI_REALTIME {
    for (std::size_t i = 0; i < sounding_; ++i) links_.retired.push(stage_[i]);
    sounding_ = 0;
    call_on_stage(nullptr);
    end_capture();
}

// ---------------------------------------------------------------------------------------------- recording

void AudioThread::start_capture(CaptureRing* ring) JAWARI_REALTIME {
    capture_ = ring;
    capture_begin_ = frame_;
    capture_skip_ = limiter_ ? limiter_->look_ahead : 0;
    capture_left_ = 0;
    recall(controllers_, [ring](const ChannelMessage& message) {
        if (!ring->messages.push({0, message})) ring->lost_messages.fetch_add(1, std::memory_order_relaxed);
    });
    const bool rests = std::all_of(stage_.begin(), stage_.begin() + static_cast<std::ptrdiff_t>(sounding_),
                                   [](const LiveInstrument* one) { return at_rest(one->state); });
    if (!rests) return;
    // Control frames and vibrato count from the state's first frame, as they will when the take is rendered.
    clock_origin_ = frame_;
    for (std::size_t i = 0; i < sounding_; ++i) set_clock(stage_[i]->state, 0);
}

void AudioThread::stop_capture() JAWARI_REALTIME {
    if (capture_ != nullptr && limiter_ && capture_left_ == 0) {
        capture_left_ = limiter_->look_ahead;
    } else {
        end_capture();
    }
}

}  // namespace jawari::host
