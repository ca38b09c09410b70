// A WAV file that appears whole or not at all.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "common/output_file.h"

struct sf_private_tag;

namespace jawari::host {

/// Encoding of a sample, with its size in bytes.
struct SampleEncoding {
    int subtype;  ///< of libsndfile: SF_FORMAT_PCM_16, ...
    unsigned bytes;
};

class SoundFile {
  public:
    /// `most_frames` decides between WAV and, beyond 4 GB, RF64.
    static Outcome<SoundFile> create(OutputFile file, std::uint32_t rate_hz, std::size_t channels,
                                     SampleEncoding encoding, std::uint64_t most_frames);

    /// Interleaved samples, a whole number of frames.
    MaybeError write(std::span<const double> samples);
    MaybeError commit();

  private:
    struct Close {
        void operator()(sf_private_tag* sound) const;
    };
    SoundFile(OutputFile file, std::unique_ptr<sf_private_tag, Close> sound, SampleEncoding encoding)
        : file_(std::move(file)), sound_(std::move(sound)), encoding_(encoding) {}
    [[nodiscard]] MaybeError failure() const;

    OutputFile file_;
    std::unique_ptr<sf_private_tag, Close> sound_;
    SampleEncoding encoding_;
    std::uint64_t bytes_ = 0;
};

}  // namespace jawari::host
