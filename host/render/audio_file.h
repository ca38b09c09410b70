// A mono WAV file for listening: PCM is clamped at full scale, float is kept as it is. Appears whole or not
// at all.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/sound_file.h"
#include "render/options.h"

namespace jawari::host {

class AudioFile {
  public:
    static Outcome<AudioFile> create(const std::string& path, std::uint32_t rate_hz, SampleFormat format,
                                     std::uint64_t most_frames);

    /// Full scale is 1.
    MaybeError write(std::span<const double> samples);
    MaybeError commit() { return sound_.commit(); }

  private:
    AudioFile(SoundFile sound, SampleFormat format) : sound_(std::move(sound)), format_(format) {}

    SoundFile sound_;
    SampleFormat format_;
    std::vector<double> clamped_;
};

}  // namespace jawari::host
