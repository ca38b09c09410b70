// A stereo output stream of one device. What happens on the audio thread is counted in atomics; the control
// thread looks at them to see whether the device still lives.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "base/error.h"

class RtAudio;

namespace jawari::host {

struct AudioRequest {
    std::string system;  ///< one of audio_systems()
    std::string device;  ///< number or part of a name; empty: the default one
    unsigned int rate_hz = 48000;
    unsigned int frames = 256;  ///< of a block; JACK and others may have their own
};

/// What the driver gives.
struct AudioFacts {
    std::string system, device;
    unsigned int rate_hz = 0;
    unsigned int frames = 0;
    long latency_frames = 0;  ///< of the driver, if it says; known once the stream runs
};

/// What the driver asks for, on the audio thread.
struct AudioBlock {
    double* left = nullptr;
    double* right = nullptr;
    std::size_t frames = 0;
    std::int64_t now_ns = 0;  ///< steady clock
    bool after_gap = false;   ///< sound was lost before this block
};

/// Fills both sides.
using AudioRender = void (*)(void* player, const AudioBlock& block);

/// Written by the audio thread alone.
struct AudioCounters {
    std::atomic<std::uint64_t> callbacks{0};
    std::atomic<std::uint64_t> frames{0};
    std::atomic<std::uint64_t> clipped{0};    ///< samples held at full scale, as drivers cannot take more
    std::atomic<int> real_time_priority{-1};  ///< of the audio thread; 0: ordinary, -1: not known yet
};

class AudioStream {
  public:
    /// Finds the device and opens it, so that rate and block size are known. Nothing sounds yet.
    static Outcome<std::unique_ptr<AudioStream>> open(const AudioRequest& request);

    AudioStream(const AudioStream&) = delete;
    AudioStream& operator=(const AudioStream&) = delete;
    /// Stops; after it the player is not called any more.
    ~AudioStream();

    /// `player` outlives the stream.
    MaybeError start(AudioRender render, void* player);

    /// False once the server or the driver has closed the stream.
    [[nodiscard]] bool is_open() const;
    [[nodiscard]] const AudioFacts& facts() const { return facts_; }
    [[nodiscard]] const AudioCounters& counters() const { return counters_; }

  private:
    AudioStream() = default;
    static int callback(void* output, void* input, unsigned int frames, double time_s, unsigned int status,
                        void* user);
    void fill(const AudioBlock& block);

    AudioFacts facts_;
    AudioCounters counters_;
    AudioRender render_ = nullptr;
    void* player_ = nullptr;
    std::unique_ptr<RtAudio> audio_;  // last: it goes first, and with it the callbacks
};

}  // namespace jawari::host
