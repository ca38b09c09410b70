#include "commands/simulate/wav_output.h"

#include <sndfile.h>

#include <cmath>
#include <string>
#include <utility>

#include "base/text.h"

namespace jawari::host {

namespace {

constexpr std::size_t most_channels = 1024;  // of libsndfile
/// A WAV header keeps the bytes per second in 32 bits.
constexpr double most_bytes_per_second = 4294967295.0;

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

Outcome<WavOutput> WavOutput::create(OutputFile file, std::size_t channels, std::uint64_t rows,
                                     double output_rate_hz) {
    if (auto error = check_format(file.path(), channels, output_rate_hz)) return *error;
    auto sound = SoundFile::create(std::move(file), static_cast<std::uint32_t>(output_rate_hz), channels,
                                   {SF_FORMAT_DOUBLE, 8}, rows);
    if (!sound) return sound.error();
    return WavOutput(std::move(sound.value()));
}

MaybeError WavOutput::write(const RowBlock& block) {
    interleaved_.clear();
    for (std::size_t i = 0; i < block.count; ++i)
        for (const auto& probe : block.probes) interleaved_.push_back(probe[i]);
    return sound_.write(interleaved_);
}

}  // namespace jawari::host
