// Bytes read as a performance: blocks of events, from playable to absurd, and what a host does between
// blocks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "jawari/instrument/render.h"

namespace jawari::fuzz {

/// Zeros after the end.
class Bytes {
  public:
    explicit Bytes(std::span<const std::uint8_t> data) : data_(data) {}
    std::uint8_t next() { return at_ < data_.size() ? data_[at_++] : std::uint8_t{0}; }
    [[nodiscard]] bool left() const { return at_ < data_.size(); }
    /// Any bit pattern: NaN with payloads, denormals.
    double number() {
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i) bits = bits << 8U | next();
        double value = 0;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }

  private:
    std::span<const std::uint8_t> data_;
    std::size_t at_ = 0;
};

enum class Between { Nothing, ChangeQuality, FadeOldest, Injure };

struct EventBlock {
    Between before = Between::Nothing;
    std::uint8_t string = 0, what = 0;  ///< of `before`
    std::uint8_t where = 0;
    std::size_t frames = 0;               ///< 0 is a block too
    std::vector<InstrumentEvent> events;  ///< in order; some at or past `frames`
};

struct Performance {
    std::uint8_t instrument = 0;
    bool guitar = false, denormals = false, frame_by_frame = false;
    bool injured = false;  ///< a motion is overwritten with what is no number
    std::vector<EventBlock> blocks;
};

inline constexpr std::size_t most_fuzzed_frames = 800;  // so that an input takes milliseconds

namespace detail {

/// Mostly `usual`; the highest bytes are far outside every range.
inline int whole(std::uint8_t byte, int first, int usual) {
    if (byte == 255) return std::numeric_limits<int>::max();
    if (byte == 254) return std::numeric_limits<int>::min();
    return byte < 224 ? first + byte % usual : byte - 239;
}

inline double odd_number(std::uint8_t byte) {
    using limits = std::numeric_limits<double>;
    static constexpr double odd[] = {limits::quiet_NaN(),
                                     limits::infinity(),
                                     -limits::infinity(),
                                     limits::max(),
                                     limits::lowest(),
                                     limits::denorm_min(),
                                     -limits::denorm_min(),
                                     -0.0,
                                     limits::min(),
                                     1 + limits::epsilon(),
                                     -limits::epsilon(),
                                     96,
                                     -96,
                                     96.0000001,
                                     -1,
                                     1e-300};
    return odd[byte % std::size(odd)];
}

inline double value_of(Bytes& bytes, InstrumentEventType type, ParameterId parameter) {
    const std::uint8_t kind = bytes.next();
    const std::uint8_t byte = bytes.next();
    if (kind >= 240) return bytes.number();
    if (kind >= 224) return odd_number(byte);
    if (type == InstrumentEventType::Bend) return (byte - 128) * (kind % 2 == 0 ? 0.75 : 0.02);
    if (type == InstrumentEventType::SetParameter && static_cast<std::size_t>(parameter) < parameter_count)
        return parameter_value(declaration_of(parameter), byte / 255.0);
    return byte / 250.0;  // a little beyond 1, too
}

inline InstrumentEvent event_of(Bytes& bytes) {
    InstrumentEvent event;
    const std::uint8_t type = bytes.next();
    event.type = static_cast<InstrumentEventType>(type < 240 ? type % 11 : type);
    event.channel = whole(bytes.next(), 0, 3);
    const std::uint8_t key = bytes.next();
    event.key = key % 8 == 7 ? -1 : whole(key, 28, 24);
    const std::uint8_t of_type = bytes.next();
    if (event.type == InstrumentEventType::SetParameter) {
        event.parameter = static_cast<ParameterId>(of_type < 240 ? of_type % parameter_count
                                                                 : std::size_t{0} - (of_type - 239U));
        if (of_type % 2 == 1) event.channel = -1;
    } else {
        event.string = of_type < 200 ? -1 : whole(static_cast<std::uint8_t>(of_type + 16), 0, 3);
    }
    event.value = value_of(bytes, event.type, event.parameter);
    return event;
}

inline EventBlock block_of(Bytes& bytes, bool injured) {
    EventBlock block;
    const std::uint8_t length = bytes.next();
    block.frames = length < 200 ? length : (length - 199U) * 9U;
    const std::uint8_t mix = bytes.next();
    const std::uint8_t before = mix / 16;
    block.before = before < 9    ? Between::Nothing
                   : before < 12 ? Between::ChangeQuality
                   : before < 13 ? Between::FadeOldest
                   : injured     ? Between::Injure
                                 : Between::Nothing;
    if (block.before != Between::Nothing) {
        block.string = bytes.next();
        block.what = bytes.next();
        block.where = bytes.next();
    }
    std::size_t frame = 0;
    for (int n = mix % 16; n > 0 && bytes.left(); --n) {
        const std::uint8_t step = bytes.next();
        if (step == 255) {
            frame = std::numeric_limits<std::size_t>::max();
        } else if (frame != std::numeric_limits<std::size_t>::max()) {
            frame += step % 64;
        }
        block.events.push_back(event_of(bytes));
        block.events.back().frame = frame;
    }
    return block;
}

}  // namespace detail

inline Performance performance_of(std::span<const std::uint8_t> data) {
    Bytes bytes(data);
    Performance performance;
    performance.instrument = bytes.next();
    const std::uint8_t flags = bytes.next();
    performance.guitar = (flags & 1U) != 0;
    performance.denormals = (flags & 2U) != 0;
    performance.frame_by_frame = (flags & 4U) != 0;
    performance.injured = (flags & 24U) == 24U;
    for (std::size_t frames = 0; bytes.left() && frames < most_fuzzed_frames;) {
        performance.blocks.push_back(detail::block_of(bytes, performance.injured));
        frames += performance.blocks.back().frames;
    }
    return performance;
}

}  // namespace jawari::fuzz
