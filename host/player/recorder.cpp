#include "player/recorder.h"

#include <chrono>
#include <utility>

namespace jawari::host {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double ring_s = 8;
constexpr std::size_t ring_messages = 65536;
constexpr auto writing_pause = std::chrono::milliseconds(20);
constexpr auto update_interval = std::chrono::milliseconds(500);
constexpr auto patience = std::chrono::seconds(1);

}  // namespace

Outcome<std::unique_ptr<LiveRecorder>> LiveRecorder::start(LivePlayer& player,
                                                           const RecordingSettings& settings) {
    std::optional<TakeSound> sound;
    std::optional<TakeMidi> midi;
    if (!settings.midi.empty()) {
        auto created = TakeMidi::create(settings.midi, settings.rate_hz, settings.overwrite);
        if (!created) return created.error();
        midi = std::move(created.value());
    }
    if (!settings.sound.empty()) {
        auto created = TakeSound::create(settings.sound, settings.rate_hz, settings.format,
                                         settings.overwrite, settings.tags);
        if (!created) return created.error();
        sound = std::move(created.value());
    }
    std::unique_ptr<LiveRecorder> recorder(new LiveRecorder(player, std::move(sound), std::move(midi)));
    const auto frames = static_cast<std::size_t>(ring_s * settings.rate_hz);
    recorder->ring_ = std::make_shared<CaptureRing>(frames, ring_messages);
    if (!player.start_capture(recorder->ring_)) {
        recorder->stopped_ = true;
        return Error{ErrorKind::Internal, "record: the audio thread does not take commands"};
    }
    recorder->thread_ = std::thread([raw = recorder.get()] { raw->run(); });
    return recorder;
}

LiveRecorder::LiveRecorder(LivePlayer& player, std::optional<TakeSound> sound, std::optional<TakeMidi> midi)
    : player_(player), sound_(std::move(sound)), midi_(std::move(midi)) {}

LiveRecorder::~LiveRecorder() {
    stop();
}

MaybeError LiveRecorder::stop() {
    if (!std::exchange(stopped_, true)) {
        player_.stop_capture();
        const auto begun = Clock::now();
        while (!ring_->ended.load(std::memory_order_acquire) && Clock::now() - begun < patience)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        stopping_.store(true);
        thread_.join();
    }
    return failure();
}

RecordingStatus LiveRecorder::status() const {
    RecordingStatus status;
    status.frames = written_frames_.load();
    status.messages = written_messages_.load();
    status.clipped = clipped_.load();
    status.lost_frames = ring_->lost_frames.load();
    status.lost_messages = ring_->lost_messages.load();
    return status;
}

MaybeError LiveRecorder::failure() const {
    const std::lock_guard lock(failure_mutex_);
    return failure_;
}

void LiveRecorder::note(const MaybeError& error) {
    if (!error) return;
    const std::lock_guard lock(failure_mutex_);
    if (!failure_) failure_ = error;
}

// ------------------------------------------------------------ writing thread

void LiveRecorder::run() {
    auto updated = Clock::now();
    for (;;) {
        const bool last = stopping_.load();  // before the ring is emptied for the last time
        while (drain()) {
        }
        if (last) break;
        if (Clock::now() - updated >= update_interval) {
            updated = Clock::now();
            update_files();
        }
        std::this_thread::sleep_for(writing_pause);
    }
    if (sound_) note(sound_->close());
    if (midi_) note(midi_->close(popped_));
}

bool LiveRecorder::drain() {
    frames_.resize(4096);
    const std::size_t count = ring_->sound.pop(frames_.data(), frames_.size());
    popped_ += count;
    const bool failed = failure().has_value();
    if (sound_ && count > 0 && !failed) {
        note(sound_->write({frames_.data(), count}));
        clipped_.store(sound_->clipped());
    }
    if (!failed) written_frames_.fetch_add(count);
    ring_->messages.consume_all([&](const CapturedMessage& message) {
        if (midi_ && !failed) midi_->add(message);
        written_messages_.fetch_add(1);
    });
    return count > 0;
}

void LiveRecorder::update_files() {
    if (failure()) return;
    if (sound_) note(sound_->update_header());
    if (midi_) note(midi_->update(popped_));
}

}  // namespace jawari::host
