#include "render/audio_file.h"

#include <sndfile.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <utility>

namespace jawari::host {

namespace {

constexpr std::uint64_t largest_wav_bytes = 4'000'000'000;

struct Encoding {
    int subtype;
    unsigned bytes;  ///< per sample
};

Encoding encoding(SampleFormat format) {
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

void AudioFile::Close::operator()(sf_private_tag* sound) const {
    sf_close(sound);
}

Outcome<AudioFile> AudioFile::create(const std::string& path, std::uint32_t rate_hz, SampleFormat format,
                                     std::uint64_t most_frames) {
    auto file = OutputFile::create(path);
    if (!file) return file.error();
    if (!file.value().seekable()) return file_error(path, "not a regular file (allowed: a file, for WAV)");
    const bool large = most_frames > largest_wav_bytes / encoding(format).bytes;
    SF_INFO info{};
    info.samplerate = static_cast<int>(rate_hz);
    info.channels = 1;
    info.format = (large ? SF_FORMAT_RF64 : SF_FORMAT_WAV) | encoding(format).subtype;
    std::unique_ptr<sf_private_tag, Close> sound(
        sf_open(file.value().temporary_path().c_str(), SFM_WRITE, &info));
    if (!sound) return file_error(path, sf_strerror(nullptr));
    // The peak chunk holds the time of writing: equal runs would give different files.
    sf_command(sound.get(), SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE);
    return AudioFile(std::move(file.value()), std::move(sound), format);
}

MaybeError AudioFile::failure() const {
    if (errno != 0) return file_error(file_.path(), errno);
    return file_error(file_.path(), sf_strerror(sound_.get()));
}

MaybeError AudioFile::write(std::span<const double> samples) {
    clamped_.assign(samples.begin(), samples.end());
    if (format_ != SampleFormat::Float) {
        for (double& sample : clamped_) sample = std::clamp(sample, -1.0, 1.0);
    }
    errno = 0;
    const auto count = static_cast<sf_count_t>(clamped_.size());
    if (sf_write_double(sound_.get(), clamped_.data(), count) != count) return failure();
    bytes_ += clamped_.size() * encoding(format_).bytes;
    return std::nullopt;
}

MaybeError AudioFile::commit() {
    errno = 0;
    sf_write_sync(sound_.get());
    if (sf_error(sound_.get()) != SF_ERR_NO_ERROR) return failure();
    if (sf_close(sound_.release()) != 0) return file_error(file_.path(), errno != 0 ? errno : EIO);
    // libsndfile does not report every failed write of its header.
    struct stat status {};
    if (fstat(file_.descriptor(), &status) != 0) return file_error(file_.path(), errno);
    if (static_cast<std::uint64_t>(status.st_size) < bytes_) return file_error(file_.path(), ENOSPC);
    return file_.commit();
}

}  // namespace jawari::host
