// Bounds-checked big-endian reading of a byte span. A failed read leaves the position where it was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace jawari::host {

class ByteReader {
  public:
    /// Reads bytes[begin, end); precondition: begin <= end <= bytes.size(). Offsets are those of `bytes`.
    ByteReader(std::span<const std::uint8_t> bytes, std::size_t begin, std::size_t end)
        : bytes_(bytes), at_(begin), end_(end) {}

    [[nodiscard]] std::size_t offset() const { return at_; }
    [[nodiscard]] std::size_t left() const { return end_ - at_; }

    std::optional<std::uint8_t> peek() const {
        if (at_ == end_) return std::nullopt;
        return bytes_[at_];
    }

    /// `count` bytes (1 to 4), most significant first.
    std::optional<std::uint32_t> big_endian(std::size_t count) {
        if (left() < count) return std::nullopt;
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < count; ++i) value = value << 8 | bytes_[at_ + i];
        at_ += count;
        return value;
    }

    /// True, and skips them, if the next bytes are `tag` (four characters).
    bool take_tag(const char* tag) {
        if (left() < 4) return false;
        for (std::size_t i = 0; i < 4; ++i) {
            if (bytes_[at_ + i] != static_cast<std::uint8_t>(tag[i])) return false;
        }
        at_ += 4;
        return true;
    }

    /// The next `count` bytes, and skips them.
    std::optional<std::span<const std::uint8_t>> take(std::size_t count) {
        if (left() < count) return std::nullopt;
        at_ += count;
        return bytes_.subspan(at_ - count, count);
    }

    bool skip(std::size_t count) {
        if (left() < count) return false;
        at_ += count;
        return true;
    }

  private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_;
    std::size_t end_;
};

}  // namespace jawari::host
