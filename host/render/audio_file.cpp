#include "render/audio_file.h"

#include <sndfile.h>

#include <algorithm>
#include <utility>

namespace jawari::host {

namespace {

SampleEncoding encoding(SampleFormat format) {
    switch (format) {
        case SampleFormat::Pcm16:
            return {SF_FORMAT_PCM_16, 2};
        case SampleFormat::Pcm24:
            return {SF_FORMAT_PCM_24, 3};
        case SampleFormat::Float:
            break;
    }
    return {SF_FORMAT_FLOAT, 4};
}

}  // namespace

Outcome<AudioFile> AudioFile::create(const std::string& path, std::uint32_t rate_hz, SampleFormat format,
                                     std::uint64_t most_frames) {
    auto file = OutputFile::create(path);
    if (!file) return file.error();
    auto sound = SoundFile::create(std::move(file.value()), rate_hz, 1, encoding(format), most_frames);
    if (!sound) return sound.error();
    return AudioFile(std::move(sound.value()), format);
}

MaybeError AudioFile::write(std::span<const double> samples) {
    if (format_ == SampleFormat::Float) return sound_.write(samples);
    clamped_.assign(samples.begin(), samples.end());
    for (double& sample : clamped_) sample = std::clamp(sample, -1.0, 1.0);
    return sound_.write(clamped_);
}

}  // namespace jawari::host
