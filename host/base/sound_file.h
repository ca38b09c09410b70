// A sound file, of the format that its name says, that appears whole or not at all. A header is written last,
// so pipes, devices and standard output get the finished file from a temporary one.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/output_file.h"

struct sf_private_tag;

namespace jawari::host {

/// What a sample is written as: whole numbers of 16 or 24 bits, or IEEE 754 single precision.
enum class SampleFormat { Pcm16, Pcm24, Float };

/// Output rates that instruments are rendered at [Hz].
inline constexpr std::uint32_t lowest_render_rate_hz = 8000;
inline constexpr std::uint32_t highest_render_rate_hz = 384000;

/// Formats of files. Ogg holds Vorbis; raw files have no header: little-endian samples alone.
enum class SoundContainer { Wav, W64, Aiff, Caf, Flac, Ogg, Raw };

/// By the end of the name, whatever its case: .wav, .w64, .aif, .aiff, .caf, .flac, .ogg, .oga, .raw. WAV for
/// names without an ending, `-`, and what is there and no regular file. Nothing for other endings.
std::optional<SoundContainer> container_of(const std::string& path);

/// What container_of() knows, for messages: `.wav, .w64, ...`.
std::string container_endings();

/// Whether its samples may be of this kind. Ogg chooses by itself: none.
bool holds(SoundContainer container, SampleFormat format);

/// Encoding of a sample, with its size in bytes, in a file of that format.
struct SampleEncoding {
    int subtype;     ///< of libsndfile: SF_FORMAT_PCM_16, ...
    unsigned bytes;  ///< 0 if samples are compressed
    SoundContainer container = SoundContainer::Wav;
};

/// Text for the INFO list and the broadcast extension ("bext", EBU Tech 3285). Nothing that changes from run
/// to run: equal runs give equal files.
struct SoundTags {
    std::string title;
    std::string comment;
};

/// For a file that has been opened for writing and has no samples yet.
void set_tags(sf_private_tag* sound, const SoundTags& tags);

class SoundFile {
  public:
    /// `most_frames` decides between WAV and, beyond 4 GB, RF64. Empty tags are left out. A usage error if
    /// the format cannot hold so many channels, such a rate or so many frames.
    static Outcome<SoundFile> create(OutputFile file, std::uint32_t rate_hz, std::size_t channels,
                                     SampleEncoding encoding, std::uint64_t most_frames,
                                     const SoundTags& tags = {});

    /// Interleaved samples, a whole number of frames.
    MaybeError write(std::span<const double> samples);
    MaybeError commit();

  private:
    struct Close {
        void operator()(sf_private_tag* sound) const;
    };
    struct CloseStream {
        void operator()(std::FILE* stream) const { std::fclose(stream); }
    };
    using Stream = std::unique_ptr<std::FILE, CloseStream>;
    SoundFile(OutputFile file, Stream spool, std::unique_ptr<sf_private_tag, Close> sound,
              SampleEncoding encoding)
        : file_(std::move(file)), spool_(std::move(spool)), sound_(std::move(sound)), encoding_(encoding) {}
    [[nodiscard]] MaybeError failure() const;
    [[nodiscard]] MaybeError check_size(int descriptor) const;
    MaybeError copy_spool();

    OutputFile file_;
    Stream spool_;  ///< nameless file that a pipe's sound is written to; null for a regular file
    std::unique_ptr<sf_private_tag, Close> sound_;
    SampleEncoding encoding_;
    std::uint64_t bytes_ = 0;
};

}  // namespace jawari::host
