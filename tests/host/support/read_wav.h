// Reads 32-bit float WAV files, without the library that writes them.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace jawari::test {

struct Wav {
    std::uint32_t rate_hz = 0;
    std::uint16_t format = 0;  ///< 1: PCM, 3: float
    std::uint16_t bits = 0;
    std::uint16_t channels = 0;
    std::string data;

    /// Interleaved. Precondition: 32-bit float.
    [[nodiscard]] std::vector<double> samples() const {
        std::vector<double> values;
        for (std::size_t i = 0; i + 4 <= data.size(); i += 4) {
            float value = 0;
            std::memcpy(&value, data.data() + i, 4);
            values.push_back(static_cast<double>(value));
        }
        return values;
    }

    /// Of one channel, from 0.
    [[nodiscard]] std::vector<double> channel(std::size_t index) const {
        const std::vector<double> all = samples();
        std::vector<double> values;
        for (std::size_t i = index; i < all.size(); i += channels) values.push_back(all[i]);
        return values;
    }
};

inline Wav read_wav(const std::string& path) {
    const std::string bytes = read_text(path);
    const auto little_endian = [&](std::size_t at, unsigned count) {
        std::uint32_t value = 0;
        for (unsigned i = 0; i < count; ++i)
            value |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(bytes.at(at + i))) << 8 * i;
        return value;
    };
    Wav wav;
    for (std::size_t at = 12; at + 8 <= bytes.size();) {
        const std::string tag = bytes.substr(at, 4);
        const std::uint32_t size = little_endian(at + 4, 4);
        if (tag == "fmt ") {
            wav.format = static_cast<std::uint16_t>(little_endian(at + 8, 2));
            wav.channels = static_cast<std::uint16_t>(little_endian(at + 10, 2));
            wav.rate_hz = little_endian(at + 12, 4);
            wav.bits = static_cast<std::uint16_t>(little_endian(at + 22, 2));
        }
        if (tag == "data") wav.data = bytes.substr(at + 8, size);
        at += 8 + size + size % 2;
    }
    return wav;
}

}  // namespace jawari::test
