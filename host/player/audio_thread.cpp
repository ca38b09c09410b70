#include "player/audio_thread.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/decibels.h"
#include "jawari/denormals.h"

namespace jawari::host {

namespace {

StageSettings settings_of_stage(const LiveSettings& settings) {
    StageSettings stage;
    stage.rate_hz = settings.rate_hz;
    stage.most_frames = settings.most_frames;
    stage.interpreter = settings.interpreter;
    stage.gain = settings.gain;
    stage.ring_out_s = settings.ring_out_s;
    stage.link = settings.link;
    return stage;
}

std::optional<Limiter> limiter_of(const LiveSettings& settings) {
    if (!settings.limiter_dbfs) return std::nullopt;
    return make_limiter(factor_of(*settings.limiter_dbfs), settings.rate_hz);
}

}  // namespace

AudioThread::AudioThread(const LiveSettings& settings, LiveLinks& links)
    : settings_(settings),
      links_(links),
      clock_(make_block_clock(settings.rate_hz)),
      stage_(settings_of_stage(settings)),
      limiter_(limiter_of(settings)) {
    governor_.settings = settings.overload;
    captured_.resize(settings.most_frames);
}

void AudioThread::process(double* left, double* right, std::size_t frames,
                          std::int64_t now_ns) JAWARI_REALTIME {
    const NoDenormals guard;
    const std::int64_t started_ns = settings_.clock();
    begin_block(clock_, now_ns, frames);
    stage_.begin_block();
    obey_commands();
    take_messages(frames);
    adapt_quality(foresee_notes(frames));
    for (std::size_t begin = 0; begin < frames;) {
        const std::size_t count = std::min(frames - begin, settings_.most_frames);
        render(left + begin, right + begin, begin, count);
        begin += count;
    }
    survey_strings();
    stage_.retire_silent();
    give_back_retired();
    measure_instruments();
    measure(frames, started_ns);
}

// ---------------------------------------------------------------------------------------------- messages

void AudioThread::take_messages(std::size_t frames) JAWARI_REALTIME {
    links_.inlet.begin_block();
    ArrivedMessage arrived;
    for (std::size_t n = 0; n < most_messages; ++n) {
        if (!stage_.has_room()) break;
        if (!links_.inlet.next(clock_, frames, arrived)) break;
        apply(arrived.message, arrived.offset);
        links_.meters.messages.fetch_add(1, std::memory_order_relaxed);
    }
}

void AudioThread::apply(const ChannelMessage& message, std::size_t offset) JAWARI_REALTIME {
    const std::size_t before = stage_.events().size();
    const MidiActions& actions = stage_.take(message, offset);
    remember(controllers_, message);
    if (actions.ignored) count_ignored(message);
    links_.meters.unplayed_notes.store(stage_.unplayed_notes(), std::memory_order_relaxed);
    show_parameters(before);
    if (actions.program.asked) links_.program.store(pack(actions.program), std::memory_order_release);
    const std::uint64_t frame = stage_.frame() + offset;
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

/// Those that the block's events from `first` on have set.
void AudioThread::show_parameters(std::size_t first) JAWARI_REALTIME {
    for (const InstrumentEvent& event : stage_.events().subspan(first)) {
        if (event.type != InstrumentEventType::SetParameter) continue;
        const auto id = static_cast<std::size_t>(event.parameter);
        for (int channel = 0; channel < static_cast<int>(midi_channel_count); ++channel) {
            if (event.channel < 0 || event.channel == channel)
                links_.meters.parameters[static_cast<std::size_t>(channel)][id].store(
                    event.value, std::memory_order_relaxed);
        }
    }
}

// ---------------------------------------------------------------------------------------------- sound

void AudioThread::render(double* left, double* right, std::size_t begin, std::size_t frames) JAWARI_REALTIME {
    stage_.render({left, right, {}}, begin, frames);
    if (limiter_) {
        for (std::size_t n = 0; n < frames; ++n) limit(*limiter_, left[n], right[n]);
    }
    measure_level(left, right, frames);
    if (capture_ != nullptr) capture(left, right, frames);
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
