#include "base/sound_file.h"

#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>

#include "base/platform.h"
#include "base/text.h"
#include "jawari/version.h"

namespace jawari::host {

namespace {

/// Of WAV and AIFF, whose chunks have lengths of 32 bits.
constexpr std::uint64_t largest_wav_bytes = 4'000'000'000;

struct Ending {
    std::string_view text;
    SoundContainer container;
};

constexpr std::array<Ending, 9> endings{{{".wav", SoundContainer::Wav},
                                         {".w64", SoundContainer::W64},
                                         {".aif", SoundContainer::Aiff},
                                         {".aiff", SoundContainer::Aiff},
                                         {".caf", SoundContainer::Caf},
                                         {".flac", SoundContainer::Flac},
                                         {".ogg", SoundContainer::Ogg},
                                         {".oga", SoundContainer::Ogg},
                                         {".raw", SoundContainer::Raw}}};

int major_format(SoundContainer container, bool large) {
    switch (container) {
        case SoundContainer::Wav:
            return large ? SF_FORMAT_RF64 : SF_FORMAT_WAV;
        case SoundContainer::W64:
            return SF_FORMAT_W64;
        case SoundContainer::Aiff:
            return SF_FORMAT_AIFF;
        case SoundContainer::Caf:
            return SF_FORMAT_CAF;
        case SoundContainer::Flac:
            return SF_FORMAT_FLAC;
        case SoundContainer::Ogg:
            return SF_FORMAT_OGG;
        case SoundContainer::Raw:
            return SF_FORMAT_RAW | SF_ENDIAN_LITTLE;
    }
    return SF_FORMAT_WAV;
}

/// What the format cannot hold.
MaybeError check_format(const std::string& path, SF_INFO info, bool large) {
    const std::string wav = "; a name that ends in .wav holds it";
    if ((info.format & SF_FORMAT_TYPEMASK) == SF_FORMAT_AIFF && large)
        return Error{ErrorKind::Usage, path + ": more than 4 GB (allowed: at most that in AIFF" + wav + ")"};
    if (sf_format_check(&info) != 0) return std::nullopt;
    return Error{ErrorKind::Usage, path + ": " + std::to_string(info.channels) + " channels at " +
                                       std::to_string(info.samplerate) +
                                       " Hz (allowed: what this format can hold" + wav + ")"};
}

/// A field of the broadcast extension: cut to its size, padded with zeros.
template <std::size_t size>
void fill(char (&field)[size], const std::string& text) {
    std::memset(field, 0, size);
    std::memcpy(field, text.data(), std::min(size, text.size()));
}

}  // namespace

std::optional<SoundContainer> container_of(const std::string& path) {
    if (path == "-") return SoundContainer::Wav;
    const std::string name = lower_case(std::filesystem::path(path).extension().string());
    for (const Ending& ending : endings)
        if (name == ending.text) return ending.container;
    const auto facts = platform::file_facts(path);
    if (name.empty() || (facts && facts->kind != platform::FileKind::Regular)) return SoundContainer::Wav;
    return std::nullopt;
}

std::string container_endings() {
    std::vector<std::string> texts;
    for (const Ending& ending : endings) texts.emplace_back(ending.text);
    return join(texts);
}

bool holds(SoundContainer container, SampleFormat format) {
    if (container == SoundContainer::Ogg) return false;
    return container != SoundContainer::Flac || format != SampleFormat::Float;
}

void set_tags(SNDFILE* sound, const SoundTags& tags) {
    if (tags.title.empty() && tags.comment.empty()) return;
    sf_set_string(sound, SF_STR_TITLE, tags.title.c_str());
    sf_set_string(sound, SF_STR_SOFTWARE, "Jawari " JAWARI_VERSION);
    sf_set_string(sound, SF_STR_COMMENT, tags.comment.c_str());
    SF_INFO info{};
    sf_command(sound, SFC_GET_CURRENT_SF_INFO, &info, sizeof info);
    const int type = info.format & SF_FORMAT_TYPEMASK;
    if (type != SF_FORMAT_WAV && type != SF_FORMAT_RF64) return;
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
    const bool large = encoding.bytes > 0 && most_frames > largest_wav_bytes / (encoding.bytes * channels);
    SF_INFO info{};
    info.samplerate = static_cast<int>(rate_hz);
    info.channels = static_cast<int>(channels);
    info.format = major_format(encoding.container, large) | encoding.subtype;
    if (auto error = check_format(file.path(), info, large)) return *error;
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
    if (encoding.container != SoundContainer::Raw) set_tags(sound.get(), tags);
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
    const bool compressed = encoding_.container == SoundContainer::Flac;
    if (!compressed) bytes_ += samples.size() * encoding_.bytes;
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
