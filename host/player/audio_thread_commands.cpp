// Commands of the control thread.
#include "player/audio_thread.h"

namespace jawari::host {

void AudioThread::obey_commands() JAWARI_REALTIME {
    while (links_.commands.read_available() > 0 && obey(links_.commands.front())) links_.commands.pop();
    stage_.take_stage();
}

/// False if it has to wait.
bool AudioThread::obey(const LiveCommand& command) JAWARI_REALTIME {
    switch (command.kind) {
        case LiveCommand::Kind::SetParameter:
            if (!stage_.has_room()) return false;
            stage_.add(set_parameter(0, command.parameter, command.value, command.channel), 0);
            show_parameters(stage_.events().size() - 1);
            return true;
        case LiveCommand::Kind::SetGain:
            stage_.set_gain(command.value);
            return true;
        case LiveCommand::Kind::Panic:
            return panic();
        case LiveCommand::Kind::Publish:
            stage_.call(command.instrument);
            give_back_retired();
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
    if (stage_.room() < most_events_of_panic) return false;
    for (std::uint8_t channel = 0; channel < midi_channel_count; ++channel) {
        const auto status = static_cast<std::uint8_t>(0xB0 + channel);
        apply({status, all_sound_off, 0}, 0);
        apply({status, reset_all_controllers, 0}, 0);
    }
    return true;
}

void AudioThread::give_back_retired() JAWARI_REALTIME {
    while (StagedInstrument* const old = stage_.next_retired()) {
        retired_counters_ += old->state.counters;
        retired_nonfinite_ += old->nonfinite_resets;
        links_.retired.push(old);
    }
}

void AudioThread::give_back_all() JAWARI_REALTIME {
    stage_.clear();
    give_back_retired();
    end_capture();
}

// ---------------------------------------------------------------------------------------------- recording

void AudioThread::start_capture(CaptureRing* ring) JAWARI_REALTIME {
    capture_ = ring;
    capture_begin_ = stage_.frame();
    capture_skip_ = limiter_ ? limiter_->look_ahead : 0;
    capture_left_ = 0;
    recall(controllers_, [ring](const ChannelMessage& message) {
        if (!ring->messages.push({0, message})) ring->lost_messages.fetch_add(1, std::memory_order_relaxed);
    });
    // Control frames and vibrato count from the state's first frame, as they will when the take is rendered.
    stage_.restart_clock();
}

void AudioThread::stop_capture() JAWARI_REALTIME {
    if (capture_ != nullptr && limiter_ && capture_left_ == 0) {
        capture_left_ = limiter_->look_ahead;
    } else {
        end_capture();
    }
}

}  // namespace jawari::host
