// The way to the loudspeakers: finds an audio system that works, notices when it is lost, and finds it again.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/error.h"
#include "devices/audio_stream.h"
#include "devices/stream_health.h"

namespace jawari::host {

struct AudioWish {
    std::string system = "auto";  ///< a word of audio_system_words(), or auto
    std::string device;           ///< empty: the default one
    unsigned int rate_hz = 48000;
    unsigned int frames = 128;
    bool frames_matter = false;  ///< they were asked for, so that others are worth a notice
};

class AudioLink {
  public:
    using Report = std::function<void(const std::string& line)>;

    AudioLink(AudioWish wish, Report report) : wish_(std::move(wish)), report_(std::move(report)) {}

    /// Tries the systems in order, reports those that fail and the one that is taken, and opens it. The
    /// player is to be made for the rate in facts(), then start() to be called.
    MaybeError open();
    MaybeError start(AudioRender render, void* player);
    void close() { stream_.reset(); }

    /// Opens what was open before, without a report unless it works; false if it does not.
    bool reopen();

    /// Whether sound still goes out; to be called several times a second. Reports when it begins to be silent
    /// or is lost. A lost stream is closed.
    StreamState check(double now_s);

    [[nodiscard]] bool is_open() const { return stream_ != nullptr; }
    /// Of the stream opened last.
    [[nodiscard]] const AudioFacts& facts() const { return facts_; }
    /// Of the stream, or null.
    [[nodiscard]] const AudioCounters* counters() const { return stream_ ? &stream_->counters() : nullptr; }

  private:
    MaybeError open_system(const std::string& system);
    void describe();

    AudioWish wish_;
    Report report_;
    AudioFacts facts_;
    std::unique_ptr<AudioStream> stream_;
    StreamHealth health_;
    StreamState state_ = StreamState::Running;
    bool priority_told_ = false;
};

}  // namespace jawari::host
