// The sound file of a performance that is being recorded: written in place, so that what has been played
// survives whatever ends the program.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/sound_file.h"
#include "player/capture_ring.h"

namespace jawari::host {

class TakeSound {
  public:
    /// Stereo. WAV, or RF64 once it passes 4 GB. An existing file is an error unless `overwrite`.
    static Outcome<TakeSound> create(const std::string& path, std::uint32_t rate_hz, SampleFormat format,
                                     bool overwrite, const SoundTags& tags);

    /// PCM is clamped at full scale, as by AudioFile.
    MaybeError write(std::span<const StereoFrame> frames);
    /// Makes the header right for what has been written. From then on a killed program leaves it behind
    /// whole.
    MaybeError update_header();
    MaybeError close();
    /// Samples beyond full scale so far.
    [[nodiscard]] std::uint64_t clipped() const { return clipped_; }

  private:
    struct Close {
        void operator()(sf_private_tag* sound) const;
    };
    TakeSound(std::string path, std::unique_ptr<sf_private_tag, Close> sound, SampleFormat format)
        : path_(std::move(path)), sound_(std::move(sound)), format_(format) {}
    [[nodiscard]] Error failure() const;

    std::string path_;
    std::unique_ptr<sf_private_tag, Close> sound_;
    SampleFormat format_;
    std::uint64_t clipped_ = 0;
    std::vector<double> interleaved_;
};

/// Opens a file to be written in place; an existing one is an error unless `overwrite`. Returns the
/// descriptor.
Outcome<int> create_in_place(const std::string& path, bool overwrite);

}  // namespace jawari::host
