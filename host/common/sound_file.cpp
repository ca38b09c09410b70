#include "common/sound_file.h"

#include <sndfile.h>
#include <sys/stat.h>

#include <cerrno>
#include <utility>

namespace jawari::host {

namespace {

constexpr std::uint64_t largest_wav_bytes = 4'000'000'000;

}  // namespace

void SoundFile::Close::operator()(sf_private_tag* sound) const {
    sf_close(sound);
}

Outcome<SoundFile> SoundFile::create(OutputFile file, std::uint32_t rate_hz, std::size_t channels,
                                     SampleEncoding encoding, std::uint64_t most_frames) {
    if (!file.seekable()) return file_error(file.path(), "not a regular file (allowed: a file, for WAV)");
    const bool large = most_frames > largest_wav_bytes / (encoding.bytes * channels);
    SF_INFO info{};
    info.samplerate = static_cast<int>(rate_hz);
    info.channels = static_cast<int>(channels);
    info.format = (large ? SF_FORMAT_RF64 : SF_FORMAT_WAV) | encoding.subtype;
    std::unique_ptr<sf_private_tag, Close> sound(sf_open(file.temporary_path().c_str(), SFM_WRITE, &info));
    if (!sound) return file_error(file.path(), sf_strerror(nullptr));
    // The peak chunk holds the time of writing: equal runs would give different files.
    sf_command(sound.get(), SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE);
    return SoundFile(std::move(file), std::move(sound), encoding);
}

MaybeError SoundFile::failure() const {
    if (errno != 0) return file_error(file_.path(), errno);
    return file_error(file_.path(), sf_strerror(sound_.get()));
}

MaybeError SoundFile::write(std::span<const double> samples) {
    errno = 0;
    const auto count = static_cast<sf_count_t>(samples.size());
    if (sf_write_double(sound_.get(), samples.data(), count) != count) return failure();
    bytes_ += samples.size() * encoding_.bytes;
    return std::nullopt;
}

MaybeError SoundFile::commit() {
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
