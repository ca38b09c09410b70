#include "devices/audio_stream.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "base/platform.h"
#include "base/text.h"
#include "devices/audio_devices.h"
#include "devices/quiet.h"
#include "devices/rtaudio_versions.h"

namespace jawari::host {

namespace {

/// Below the servers' own threads (JACK: 10 to 70), above everything that is not sound.
constexpr int wanted_priority = 60;

std::int64_t steady_now_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Integer formats of drivers wrap around beyond full scale. The number of samples that were held.
std::uint64_t hold_at_full_scale(double* samples, std::size_t count) {
    std::uint64_t held = 0;
    for (std::size_t n = 0; n < count; ++n) {
        const double within = std::clamp(samples[n], -1.0, 1.0);
        held += within != samples[n] ? 1U : 0U;
        samples[n] = within;
    }
    return held;
}

Outcome<AudioDevice> find_device(const AudioRequest& request) {
    const auto devices = audio_devices(request.system);
    if (!devices) return devices.error();
    if (devices.value().empty())
        return Error{ErrorKind::Device, request.system == "jack" ? "no server" : "no device"};
    if (request.device.empty()) {
        for (const AudioDevice& each : devices.value())
            if (each.is_default) return each;
        return devices.value().front();
    }
    std::vector<std::string> names;
    for (const AudioDevice& each : devices.value()) names.push_back(each.name);
    const auto index = match_name(names, request.device, "audio device");
    if (!index) return index.error();
    return devices.value()[index.value()];
}

}  // namespace

Outcome<std::unique_ptr<AudioStream>> AudioStream::open(const AudioRequest& request) {
    const auto device = find_device(request);
    if (!device) return device.error();
    std::unique_ptr<AudioStream> stream(new AudioStream);
    const QuietStandardError quiet;
    stream->audio_ = rtaudio::make(RtAudio::getCompiledApiByName(request.system));
    if (!stream->audio_) return Error{ErrorKind::Device, "cannot be used here"};

    RtAudio::StreamOptions options;
    options.flags = RTAUDIO_NONINTERLEAVED | RTAUDIO_SCHEDULE_REALTIME;
    options.priority = wanted_priority;
    options.numberOfBuffers = 2;
    options.streamName = "jawari";
    unsigned int frames = request.frames;
    const unsigned int rate_hz = choose_rate(device.value(), request.rate_hz);
    if (auto error = rtaudio::open(*stream->audio_, device.value().id, rate_hz, frames, options, &callback,
                                   stream.get()))
        return *error;
    stream->facts_ = {request.system, device.value().name, stream->audio_->getStreamSampleRate(), frames, 0};
    return stream;
}

AudioStream::~AudioStream() {
    const QuietStandardError quiet;
    if (audio_) rtaudio::stop(*audio_);
    audio_.reset();
}

MaybeError AudioStream::start(AudioRender render, void* player) {
    render_ = render;
    player_ = player;
    const QuietStandardError quiet;
    if (auto error = rtaudio::start(*audio_)) return error;
    facts_.latency_frames = audio_->getStreamLatency();
    return std::nullopt;
}

bool AudioStream::is_open() const {
    return audio_->isStreamOpen();
}

int AudioStream::callback(void* output, void* /*input*/, unsigned int frames, double /*time_s*/,
                          unsigned int status, void* user) {
    auto* left = static_cast<double*>(output);
    const bool after_gap = (status & RTAUDIO_OUTPUT_UNDERFLOW) != 0;
    static_cast<AudioStream*>(user)->fill({left, left + frames, frames, steady_now_ns(), after_gap});
    return 0;
}

void AudioStream::fill(const AudioBlock& block) {
    const auto add = [](std::atomic<std::uint64_t>& counter, std::uint64_t amount) {
        counter.store(counter.load(std::memory_order_relaxed) + amount, std::memory_order_relaxed);
    };
    if (counters_.real_time_priority.load(std::memory_order_relaxed) < 0)
        counters_.real_time_priority.store(platform::own_real_time_priority(), std::memory_order_relaxed);
    render_(player_, block);
    add(counters_.clipped,
        hold_at_full_scale(block.left, block.frames) + hold_at_full_scale(block.right, block.frames));
    add(counters_.frames, block.frames);
    add(counters_.callbacks, 1);
}

}  // namespace jawari::host
