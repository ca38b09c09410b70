#include "base/sound_file.h"

#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/platform.h"
#include "jawari/version.h"

namespace jawari::host {

namespace {

constexpr std::uint64_t largest_wav_bytes = 4'000'000'000;

/// A field of the broadcast extension: cut to its size, padded with zeros.
template <std::size_t size>
void fill(char (&field)[size], const std::string& text) {
    std::memset(field, 0, size);
    std::memcpy(field, text.data(), std::min(size, text.size()));
}

}  // namespace

void set_tags(SNDFILE* sound, const SoundTags& tags) {
    if (tags.title.empty() && tags.comment.empty()) return;
    sf_set_string(sound, SF_STR_TITLE, tags.title.c_str());
    sf_set_string(sound, SF_STR_SOFTWARE, "Jawari " JAWARI_VERSION);
    sf_set_string(sound, SF_STR_COMMENT, tags.comment.c_str());
    SF_BROADCAST_INFO broadcast{};
    fill(broadcast.description, tags.title + ": " + tags.comment);
    fill(broadcast.originator, "Jawari " JAWARI_VERSION);
    broadcast.version = 1;
    sf_command(sound, SFC_SET_BROADCAST_INFO, &broadcast, sizeof broadcast);
}

void SoundFile::Close::operator()(sf_private_tag* sound) const {
    sf_close(sound);
}

Outcome<SoundFile> SoundFile::create(OutputFile file, std::uint32_t rate_hz, std::size_t channels,
                                     SampleEncoding encoding, std::uint64_t most_frames,
                                     const SoundTags& tags) {
    const bool large = most_frames > largest_wav_bytes / (encoding.bytes * channels);
    SF_INFO info{};
    info.samplerate = static_cast<int>(rate_hz);
    info.channels = static_cast<int>(channels);
    info.format = (large ? SF_FORMAT_RF64 : SF_FORMAT_WAV) | encoding.subtype;
    Stream spool;
    std::unique_ptr<sf_private_tag, Close> sound;
    if (file.seekable()) {
        sound.reset(sf_open(file.temporary_path().c_str(), SFM_WRITE, &info));
    } else {
        spool.reset(std::tmpfile());
        if (!spool) return file_error(file.path(), errno);
        sound.reset(sf_open_fd(platform::descriptor_of(spool.get()), SFM_WRITE, &info, SF_FALSE));
    }
    if (!sound) return file_error(file.path(), sf_strerror(nullptr));
    // The peak chunk holds the time of writing: equal runs would give different files.
    sf_command(sound.get(), SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE);
    set_tags(sound.get(), tags);
    return SoundFile(std::move(file), std::move(spool), std::move(sound), encoding);
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

/// libsndfile does not report every failed write of its header.
MaybeError SoundFile::check_size(int descriptor) const {
    const auto facts = platform::file_facts(descriptor);
    if (!facts) return file_error(file_.path(), errno);
    if (facts->bytes < bytes_) return file_error(file_.path(), ENOSPC);
    return std::nullopt;
}

MaybeError SoundFile::copy_spool() {
    std::rewind(spool_.get());
    std::array<char, 65536> buffer{};
    for (;;) {
        const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), spool_.get());
        if (count == 0) break;
        if (auto error = file_.write({buffer.data(), count})) return error;
    }
    if (std::ferror(spool_.get()) != 0) return file_error(file_.path(), EIO);
    return std::nullopt;
}

MaybeError SoundFile::commit() {
    errno = 0;
    sf_write_sync(sound_.get());
    if (sf_error(sound_.get()) != SF_ERR_NO_ERROR) return failure();
    if (sf_close(sound_.release()) != 0) return file_error(file_.path(), errno != 0 ? errno : EIO);
    if (auto error = check_size(spool_ ? platform::descriptor_of(spool_.get()) : file_.descriptor()))
        return error;
    if (spool_) {
        if (auto error = copy_spool()) return error;
    }
    return file_.commit();
}

}  // namespace jawari::host
