// A mono WAV file for listening: PCM is clamped at full scale, float is kept as it is. Appears whole or not
// at all.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/output_file.h"
#include "render/options.h"

struct sf_private_tag;

namespace jawari::host {

class AudioFile {
  public:
    /// `most_frames` decides between WAV and, beyond 4 GiB, RF64.
    static Outcome<AudioFile> create(const std::string& path, std::uint32_t rate_hz, SampleFormat format,
                                     std::uint64_t most_frames);

    /// Full scale is 1.
    MaybeError write(std::span<const double> samples);
    MaybeError commit();

  private:
    struct Close {
        void operator()(sf_private_tag* sound) const;
    };
    AudioFile(OutputFile file, std::unique_ptr<sf_private_tag, Close> sound, SampleFormat format)
        : file_(std::move(file)), sound_(std::move(sound)), format_(format) {}
    [[nodiscard]] MaybeError failure() const;

    OutputFile file_;
    std::unique_ptr<sf_private_tag, Close> sound_;
    SampleFormat format_;
    std::vector<double> clamped_;
    std::uint64_t bytes_ = 0;
};

}  // namespace jawari::host
