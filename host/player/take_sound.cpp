#include "player/take_sound.h"

#include <sndfile.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>

#include "base/platform.h"

namespace jawari::host {

namespace {

int subtype(SampleFormat format) {
    switch (format) {
        case SampleFormat::Pcm16:
            return SF_FORMAT_PCM_16;
        case SampleFormat::Pcm24:
            return SF_FORMAT_PCM_24;
        case SampleFormat::Float:
            break;
    }
    return SF_FORMAT_FLOAT;
}

}  // namespace

Outcome<int> create_in_place(const std::string& path, bool overwrite) {
    const int descriptor = platform::create_file(path, overwrite);
    if (descriptor >= 0) return descriptor;
    if (errno == EEXIST) return file_error(path, "exists already (allowed: a new file, or --force)");
    return file_error(path, errno);
}

void TakeSound::Close::operator()(sf_private_tag* sound) const {
    sf_close(sound);
}

Outcome<TakeSound> TakeSound::create(const std::string& path, std::uint32_t rate_hz, SampleFormat format,
                                     bool overwrite, const SoundTags& tags) {
    auto descriptor = create_in_place(path, overwrite);
    if (!descriptor) return descriptor.error();
    SF_INFO info{};
    info.samplerate = static_cast<int>(rate_hz);
    info.channels = 2;
    info.format = SF_FORMAT_RF64 | subtype(format);
    std::unique_ptr<sf_private_tag, Close> sound(sf_open_fd(descriptor.value(), SFM_WRITE, &info, SF_TRUE));
    if (!sound) {
        platform::close_file(descriptor.value());
        return file_error(path, sf_strerror(nullptr));
    }
    // The header says WAV for as long as the file is small enough for that.
    sf_command(sound.get(), SFC_RF64_AUTO_DOWNGRADE, nullptr, SF_TRUE);
    // The peak chunk holds the time of writing: equal performances would give different files.
    sf_command(sound.get(), SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE);
    set_tags(sound.get(), tags);
    TakeSound take(path, std::move(sound), format);
    if (auto error = take.update_header()) return *error;
    return take;
}

Error TakeSound::failure() const {
    if (errno != 0) return file_error(path_, errno);
    return file_error(path_, sf_strerror(sound_.get()));
}

MaybeError TakeSound::write(std::span<const StereoFrame> frames) {
    interleaved_.clear();
    for (const StereoFrame& frame : frames) {
        for (const double sample : {frame.left, frame.right}) {
            if (std::abs(sample) > 1) clipped_ += 1;
            interleaved_.push_back(format_ == SampleFormat::Float ? sample : std::clamp(sample, -1.0, 1.0));
        }
    }
    errno = 0;
    const auto count = static_cast<sf_count_t>(interleaved_.size());
    if (sf_write_double(sound_.get(), interleaved_.data(), count) != count) return failure();
    return std::nullopt;
}

MaybeError TakeSound::update_header() {
    errno = 0;
    sf_command(sound_.get(), SFC_UPDATE_HEADER_NOW, nullptr, 0);
    if (sf_error(sound_.get()) != SF_ERR_NO_ERROR) return failure();
    return std::nullopt;
}

MaybeError TakeSound::close() {
    errno = 0;
    sf_write_sync(sound_.get());
    if (sf_close(sound_.release()) != 0) return file_error(path_, errno != 0 ? errno : EIO);
    return std::nullopt;
}

}  // namespace jawari::host
