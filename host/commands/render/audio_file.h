// A sound file for listening: PCM is clamped at full scale, float is kept as it is. Appears whole or not at
// all.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "base/sound_file.h"
#include "commands/render/options.h"

namespace jawari::host {

struct AudioFormat {
    std::uint32_t rate_hz = 48000;
    SampleFormat samples = SampleFormat::Pcm24;
    std::uint64_t most_frames = 0;
    SoundTags tags;
};

class AudioFile {
  public:
    static Outcome<AudioFile> create(const std::string& path, std::size_t channels,
                                     const AudioFormat& format);

    /// One span per channel, all of the same length. Full scale is 1.
    MaybeError write(std::span<const std::span<const double>> channels);
    MaybeError commit() { return sound_.commit(); }
    /// Samples beyond full scale so far.
    [[nodiscard]] std::uint64_t clipped() const { return clipped_; }

  private:
    AudioFile(SoundFile sound, SampleFormat format) : sound_(std::move(sound)), format_(format) {}

    SoundFile sound_;
    SampleFormat format_;
    std::uint64_t clipped_ = 0;
    std::vector<double> interleaved_;
    std::mt19937 dither_;  ///< always from the same seed: the same command gives the same bytes
};

}  // namespace jawari::host
