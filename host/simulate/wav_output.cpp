#include "simulate/wav_output.h"

#include <sndfile.h>
#include <sys/stat.h>

#include <cerrno>
#include <cmath>
#include <string>

#include "common/text.h"

namespace jawari::host {

namespace {

constexpr std::size_t most_channels = 1024;  // of libsndfile
/// A WAV header keeps the bytes per second in 32 bits.
constexpr double most_bytes_per_second = 4294967295.0;
constexpr double largest_wav_bytes = 4.0e9;

MaybeError check_format(const std::string& path, std::size_t channels, double rate_hz) {
    if (channels > most_channels)
        return usage_error("--out", path,
                           "for WAV at most 1024 probes, the scene has " + std::to_string(channels));
    const bool whole = rate_hz == std::floor(rate_hz);
    const double most = std::floor(most_bytes_per_second / (8.0 * static_cast<double>(channels)));
    if (!whole || rate_hz > most)
        return usage_error("--out", path,
                           "for WAV an output rate that is a whole number of hertz up to " + shortest(most) +
                               ", not " + shortest(rate_hz));
    return std::nullopt;
}

}  // namespace

void WavOutput::Close::operator()(sf_private_tag* sound) const {
    sf_close(sound);
}

Outcome<WavOutput> WavOutput::create(OutputFile file, std::size_t channels, std::uint64_t rows,
                                     double output_rate_hz) {
    if (auto error = check_format(file.path(), channels, output_rate_hz)) return *error;
    if (!file.seekable()) return file_error(file.path(), "not a regular file (allowed: a file, for WAV)");
    const bool large = static_cast<double>(rows) * static_cast<double>(channels) * 8.0 > largest_wav_bytes;
    SF_INFO info{};
    info.samplerate = static_cast<int>(output_rate_hz);
    info.channels = static_cast<int>(channels);
    info.format = (large ? SF_FORMAT_RF64 : SF_FORMAT_WAV) | SF_FORMAT_DOUBLE;
    std::unique_ptr<sf_private_tag, Close> sound(sf_open(file.temporary_path().c_str(), SFM_WRITE, &info));
    if (!sound) return file_error(file.path(), sf_strerror(nullptr));
    // The peak chunk holds the time of writing: equal runs would give different files.
    sf_command(sound.get(), SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE);
    return WavOutput(std::move(file), std::move(sound));
}

MaybeError WavOutput::failure() const {
    if (errno != 0) return file_error(file_.path(), errno);
    return file_error(file_.path(), sf_strerror(sound_.get()));
}

MaybeError WavOutput::write(const RowBlock& block) {
    interleaved_.clear();
    for (std::size_t i = 0; i < block.count; ++i)
        for (const auto& probe : block.probes) interleaved_.push_back(probe[i]);
    errno = 0;
    const auto rows = static_cast<sf_count_t>(block.count);
    if (sf_writef_double(sound_.get(), interleaved_.data(), rows) != rows) return failure();
    bytes_ += interleaved_.size() * sizeof(double);
    return std::nullopt;
}

MaybeError WavOutput::commit() {
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
