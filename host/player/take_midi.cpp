#include "player/take_midi.h"

#include <algorithm>
#include <cerrno>
#include <utility>

#include "base/platform.h"
#include "midi/system_message.h"
#include "player/take_sound.h"

namespace jawari::host {

namespace {

constexpr std::size_t header_bytes = 14;
constexpr std::size_t track_header_bytes = 8;
constexpr std::uint64_t largest_delta = (1U << 28U) - 1;  // four groups of seven bits

void append_big_endian(std::string& bytes, std::uint32_t value, int count) {
    for (int shift = 8 * (count - 1); shift >= 0; shift -= 8)
        bytes.push_back(static_cast<char>(value >> static_cast<unsigned>(shift) & 0xFFU));
}

void append_variable_length(std::string& bytes, std::uint32_t value) {
    for (int shift = 21; shift > 0; shift -= 7) {
        if (value >> static_cast<unsigned>(shift) != 0)
            bytes.push_back(static_cast<char>(0x80U | (value >> static_cast<unsigned>(shift) & 0x7FU)));
    }
    bytes.push_back(static_cast<char>(value & 0x7FU));
}

std::string file_header(const FrameTicks& ticks) {
    std::string bytes = "MThd";
    append_big_endian(bytes, 6, 4);
    append_big_endian(bytes, 0, 2);  // one track
    append_big_endian(bytes, 1, 2);
    append_big_endian(bytes, ticks.division, 2);
    return bytes;
}

std::string tempo_event(const FrameTicks& ticks) {
    std::string bytes("\x00\xFF\x51\x03", 4);
    append_big_endian(bytes, ticks.us_per_quarter, 3);
    return bytes;
}

/// A delta time, over as many empty text events as it takes.
void append_delta_time(std::string& bytes, std::uint64_t delta) {
    for (; delta > largest_delta; delta -= largest_delta) {
        append_variable_length(bytes, static_cast<std::uint32_t>(largest_delta));
        bytes.append("\xFF\x01\x00", 3);
    }
    append_variable_length(bytes, static_cast<std::uint32_t>(delta));
}

}  // namespace

std::optional<FrameTicks> ticks_per_frame(std::uint32_t rate_hz) {
    constexpr std::uint32_t second_us = 1000000;
    for (std::uint32_t divisor = 1; divisor <= second_us; ++divisor) {
        if (second_us % divisor != 0 || rate_hz % divisor != 0) continue;
        if (rate_hz / divisor <= 32767)
            return FrameTicks{static_cast<std::uint16_t>(rate_hz / divisor), second_us / divisor};
    }
    return std::nullopt;
}

Outcome<TakeMidi> TakeMidi::create(const std::string& path, std::uint32_t rate_hz, bool overwrite) {
    const auto ticks = ticks_per_frame(rate_hz);
    if (!ticks)
        return usage_error("--record-midi with the rate", std::to_string(rate_hz),
                           "up to 32767, or a multiple of 100: one tick of a MIDI file is one frame");
    auto descriptor = create_in_place(path, overwrite);
    if (!descriptor) return descriptor.error();
    TakeMidi take(path, descriptor.value());
    const std::string header = file_header(*ticks);
    if (auto error = take.write_at(0, header)) return *error;
    take.track_end_ = header_bytes + track_header_bytes;
    take.pending_ = tempo_event(*ticks);
    if (auto error = take.update(0)) return *error;
    return take;
}

TakeMidi::TakeMidi(TakeMidi&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      pending_(std::move(other.pending_)),
      track_end_(other.track_end_),
      frame_(other.frame_),
      open_(std::move(other.open_)) {}

TakeMidi& TakeMidi::operator=(TakeMidi&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    std::swap(pending_, other.pending_);
    std::swap(track_end_, other.track_end_);
    std::swap(frame_, other.frame_);
    std::swap(open_, other.open_);
    return *this;
}

TakeMidi::~TakeMidi() {
    if (descriptor_ >= 0) platform::close_file(descriptor_);
}

void TakeMidi::add(const CapturedMessage& captured) {
    const std::uint64_t frame = std::max(frame_, captured.frame);
    append_delta_time(pending_, frame - frame_);
    frame_ = frame;
    const ChannelMessage& message = captured.message;
    if (is_system(message)) {
        const auto body = private_exclusive(message);
        pending_.push_back(static_cast<char>(0xF0));
        append_variable_length(pending_, static_cast<std::uint32_t>(body.size() + 1));
        pending_.append(body.begin(), body.end());
        pending_.push_back(static_cast<char>(0xF7));
        return;
    }
    note_key(message);
    pending_.push_back(static_cast<char>(message.status));
    pending_.push_back(static_cast<char>(message.data1));
    if (data_bytes(message.status) == 2) pending_.push_back(static_cast<char>(message.data2));
}

void TakeMidi::note_key(const ChannelMessage& message) {
    const unsigned kind = message.status & 0xF0U;
    if (kind != 0x80 && kind != 0x90) return;
    std::uint16_t& open = open_[(message.status & 0xFU) << 7U | (message.data1 & 0x7FU)];
    if (kind == 0x90 && message.data2 > 0) {
        open = static_cast<std::uint16_t>(std::min(open + 1, 0xFFFF));
    } else if (open > 0) {
        open = static_cast<std::uint16_t>(open - 1);
    }
}

/// The events first, then the length that makes them count. A program killed between the two calls,
/// microseconds, leaves a track whose last event is cut.
MaybeError TakeMidi::update(std::uint64_t end_frame) {
    std::string bytes = pending_;
    append_delta_time(bytes, end_frame > frame_ ? end_frame - frame_ : 0);
    // A reader that completes missing note-offs would end notes of keys that are down before they were let
    // go.
    for (std::size_t key = 0; key < open_.size(); ++key) {
        for (unsigned count = open_[key]; count > 0; --count) {
            bytes.push_back(static_cast<char>(0x80U | key >> 7U));
            bytes.push_back(static_cast<char>(key & 0x7FU));
            bytes.append("\x40\x00", 2);  // and the delta time of what follows
        }
    }
    bytes.append("\xFF\x2F\x00", 3);
    if (auto error = write_at(track_end_, bytes)) return error;
    const std::uint64_t length = track_end_ + bytes.size() - header_bytes - track_header_bytes;
    std::string track = "MTrk";
    append_big_endian(track, static_cast<std::uint32_t>(length), 4);
    if (auto error = write_at(header_bytes, track)) return error;
    track_end_ += pending_.size();
    pending_.clear();
    return std::nullopt;
}

MaybeError TakeMidi::close(std::uint64_t end_frame) {
    if (auto error = update(end_frame)) return error;
    const int descriptor = std::exchange(descriptor_, -1);
    if (!platform::flush_content_to_disk(descriptor) && errno != EINVAL) {
        const int reason = errno;
        platform::close_file(descriptor);
        return file_error(path_, reason);
    }
    if (!platform::close_file(descriptor)) return file_error(path_, errno);
    return std::nullopt;
}

MaybeError TakeMidi::write_at(std::uint64_t offset, const std::string& bytes) {
    std::string_view left = bytes;
    while (!left.empty()) {
        const std::ptrdiff_t count = platform::write_some_at(descriptor_, offset, left);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return file_error(path_, count < 0 ? errno : EIO);
        left.remove_prefix(static_cast<std::size_t>(count));
        offset += static_cast<std::uint64_t>(count);
    }
    return std::nullopt;
}

}  // namespace jawari::host
