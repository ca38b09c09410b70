#include "commands/render/audio_file.h"

#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace jawari::host {

namespace {

SampleEncoding encoding(SampleFormat format, SoundContainer container) {
    if (container == SoundContainer::Ogg) return {SF_FORMAT_VORBIS, 0, container};
    switch (format) {
        case SampleFormat::Pcm16:
            return {SF_FORMAT_PCM_16, 2, container};
        case SampleFormat::Pcm24:
            return {SF_FORMAT_PCM_24, 3, container};
        case SampleFormat::Float:
            break;
    }
    return {SF_FORMAT_FLOAT, 4, container};
}

/// One step of 16-bit samples, as libsndfile scales them.
constexpr double step_16_bit = 1.0 / 32767;

/// Noise of triangular density, two steps wide: rounding then leaves an error that does not depend on the
/// sound (Lipshitz, Wannamaker, Vanderkooy, J. Audio Eng. Soc. 40 (1992) 355).
double triangular_noise(std::mt19937& random) {
    constexpr double range = 4294967296.0;
    const double first = static_cast<double>(random()) / range;
    const double second = static_cast<double>(random()) / range;
    return (first - second) * step_16_bit;
}

}  // namespace

Outcome<AudioFile> AudioFile::create(const std::string& path, std::size_t channels,
                                     const AudioFormat& format) {
    auto file = OutputFile::create(path);
    if (!file) return file.error();
    auto sound = SoundFile::create(std::move(file.value()), format.rate_hz, channels,
                                   encoding(format.samples, container_of(path).value_or(SoundContainer::Wav)),
                                   format.most_frames, format.tags);
    if (!sound) return sound.error();
    return AudioFile(std::move(sound.value()), format.samples);
}

MaybeError AudioFile::write(std::span<const std::span<const double>> channels) {
    const std::size_t frames = channels.empty() ? 0 : channels.front().size();
    interleaved_.clear();
    for (std::size_t n = 0; n < frames; ++n) {
        for (const auto& channel : channels) {
            double sample = channel[n];
            if (std::abs(sample) > 1) clipped_ += 1;
            // Digital silence is exact without noise.
            if (format_ == SampleFormat::Pcm16 && sample != 0) sample += triangular_noise(dither_);
            interleaved_.push_back(format_ == SampleFormat::Float ? sample : std::clamp(sample, -1.0, 1.0));
        }
    }
    return sound_.write(interleaved_);
}

}  // namespace jawari::host
