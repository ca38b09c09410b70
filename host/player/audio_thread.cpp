#include "player/audio_thread.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "jawari/denormals.h"

namespace jawari::host {

namespace {

/// Of a block; more wait for the next.
constexpr std::size_t most_events = 16384;

std::optional<Limiter> limiter_of(const LiveSettings& settings) {
    if (!settings.limiter_dbfs) return std::nullopt;
    return make_limiter(std::pow(10.0, *settings.limiter_dbfs / 20), settings.rate_hz);
}

}  // namespace

AudioThread::AudioThread(const LiveSettings& settings, LiveLinks& links)
    : settings_(settings),
      links_(links),
      interpreter_(make_interpreter(settings.interpreter)),
      clock_(make_block_clock(settings.rate_hz)),
      gain_(settings.gain),
      gain_target_(settings.gain),
      limiter_(limiter_of(settings)) {
    governor_.settings = settings.overload;
    events_.reserve(most_events);
    chunk_.reserve(most_events);
    gains_.assign(settings.most_frames, settings.gain);
    captured_.resize(settings.most_frames);
}

void AudioThread::process(double* left, double* right, std::size_t frames,
                          std::int64_t now_ns) JAWARI_REALTIME {
    const NoDenormals guard;
    const std::int64_t started_ns = settings_.clock();
    begin_block(clock_, now_ns, frames);
    events_.clear();
    obey_commands();
    take_messages(frames);
    adapt_quality();
    for (std::size_t begin = 0; begin < frames;) {
        const std::size_t count = std::min(frames - begin, settings_.most_frames);
        render(left + begin, right + begin, begin, count);
        begin += count;
    }
    survey_strings();
    retire_silent();
    measure_instruments();
    measure(frames, started_ns);
}

// ---------------------------------------------------------------------------------------------- messages

void AudioThread::take_messages(std::size_t frames) JAWARI_REALTIME {
    links_.inlet.begin_block();
    ArrivedMessage arrived;
    for (std::size_t n = 0; n < most_messages; ++n) {
        if (events_.size() + most_events_per_message > most_events) break;
        if (!links_.inlet.next(clock_, frames, arrived)) break;
        apply(arrived.message, arrived.offset);
        links_.meters.messages.fetch_add(1, std::memory_order_relaxed);
    }
}

void AudioThread::apply(const ChannelMessage& message, std::size_t offset) JAWARI_REALTIME {
    interpret(interpreter_, message, actions_);
    remember(controllers_, message);
    if (actions_.ignored) count_ignored(message);
    for (std::size_t i = 0; i < actions_.count; ++i) add_event(actions_.events[i], offset);
    if (actions_.program.asked) {
        const ProgramRequest& asked = actions_.program;
        links_.program.store(pack(asked), std::memory_order_release);
    }
    const std::uint64_t frame = frame_ + offset;
    if (capture_ != nullptr && capture_left_ == 0 &&
        !capture_->messages.push({frame - capture_begin_, message}))
        capture_->lost_messages.fetch_add(1, std::memory_order_relaxed);
    if (links_.monitor.load(std::memory_order_relaxed)) links_.applied.push({frame, message});
}

void AudioThread::count_ignored(const ChannelMessage& message) JAWARI_REALTIME {
    LiveMeters& meters = links_.meters;
    std::atomic<std::uint64_t>* count = &meters.moved_notes;
    if (kind_of(message) == MessageKind::ControlChange)
        count =
            is_data_entry(message.data1) ? &meters.ignored_data : &meters.ignored_controllers[message.data1];
    count->fetch_add(1, std::memory_order_relaxed);
}

void AudioThread::add_event(InstrumentEvent event, std::size_t offset) JAWARI_REALTIME {
    // As make_score(): in guitar mode, other channels have no strings.
    const bool guitar = settings_.interpreter.guitar_channel >= 0;
    if (guitar && event.type == InstrumentEventType::NoteOn && event.string < 0) {
        links_.meters.unplayed_notes.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    event.frame = offset;
    events_.push_back(event);
    if (event.type != InstrumentEventType::SetParameter) return;
    const auto id = static_cast<std::size_t>(event.parameter);
    for (int channel = 0; channel < static_cast<int>(midi_channel_count); ++channel) {
        if (event.channel < 0 || event.channel == channel)
            links_.meters.parameters[static_cast<std::size_t>(channel)][id].store(event.value,
                                                                                  std::memory_order_relaxed);
    }
}

// ---------------------------------------------------------------------------------------------- sound

void AudioThread::render(double* left, double* right, std::size_t begin, std::size_t frames) JAWARI_REALTIME {
    std::fill(left, left + frames, 0.0);
    std::fill(right, right + frames, 0.0);
    follow_gain(frames);
    for (std::size_t i = 0; i < sounding_; ++i) render_one(*stage_[i], i == 0, begin, frames, left, right);
    if (limiter_) {
        for (std::size_t n = 0; n < frames; ++n) limit(*limiter_, left[n], right[n]);
    }
    measure_level(left, right, frames);
    if (capture_ != nullptr) capture(left, right, frames);
    frame_ += frames;
}

void AudioThread::follow_gain(std::size_t frames) JAWARI_REALTIME {
    for (std::size_t n = 0; n < frames; ++n) {
        if (gain_ != gain_target_) {
            const double left = gain_target_ - gain_;
            gain_ = std::abs(left) <= std::abs(gain_rate_) ? gain_target_ : gain_ + gain_rate_;
        }
        gains_[n] = gain_;
    }
}

void AudioThread::render_one(LiveInstrument& instrument, bool plays, std::size_t begin, std::size_t frames,
                             double* left, double* right) JAWARI_REALTIME {
    chunk_.clear();
    for (const InstrumentEvent& event : events_) {
        if (event.frame < begin || event.frame >= begin + frames) continue;
        if (!plays && event.type == InstrumentEventType::NoteOn) continue;
        chunk_.push_back(event);
        chunk_.back().frame -= begin;
    }
    const InstrumentOutput output{instrument.left.data(), instrument.right.data(), {}};
    render_instrument(instrument.loaded->model, instrument.state, chunk_, output, frames);
    if (instrument.fading) fade(instrument, frames);
    for (std::size_t n = 0; n < frames; ++n) {
        left[n] += gains_[n] * instrument.left[n];
        right[n] += gains_[n] * instrument.right[n];
    }
    if (!plays) instrument.ring_frames += frames;
}

void AudioThread::capture(const double* left, const double* right, std::size_t frames) JAWARI_REALTIME {
    const std::size_t skipped = std::min(capture_skip_, frames);
    capture_skip_ -= skipped;
    std::size_t end = frames;
    if (capture_left_ > 0) end = std::min(frames, skipped + capture_left_);
    for (std::size_t n = skipped; n < end; ++n) captured_[n - skipped] = {left[n], right[n]};
    const std::size_t count = end - skipped;
    const std::size_t pushed = capture_->sound.push(captured_.data(), count);
    capture_->frames.fetch_add(count, std::memory_order_relaxed);
    if (pushed < count) {
        const std::uint64_t lost = count - pushed;
        if (capture_->lost_frames.fetch_add(lost, std::memory_order_relaxed) == 0)
            notify(LiveNotice::Kind::LostCapture, static_cast<double>(lost));
    }
    if (capture_left_ == 0) return;
    capture_left_ -= count;
    if (capture_left_ == 0) end_capture();
}

void AudioThread::end_capture() JAWARI_REALTIME {
    if (capture_ == nullptr) return;
    capture_left_ = 0;
    // The other side may free the ring from here on.
    std::exchange(capture_, nullptr)->ended.store(true, std::memory_order_release);
}

}  // namespace jawari::host
