// Records a performance while it goes on: a thread of its own empties the ring that the audio thread fills.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "base/error.h"
#include "player/capture_ring.h"
#include "player/player.h"
#include "player/take_midi.h"
#include "player/take_sound.h"

namespace jawari::host {

struct RecordingSettings {
    std::string sound;  ///< a WAV file; empty: none
    std::string midi;   ///< a MIDI file; empty: none
    std::uint32_t rate_hz = 48000;
    SampleFormat format = SampleFormat::Float;
    bool overwrite = false;  ///< existing files
    SoundTags tags;
};

struct RecordingStatus {
    std::uint64_t frames = 0;       ///< in the file
    std::uint64_t messages = 0;     ///< likewise
    std::uint64_t lost_frames = 0;  ///< the writer was too slow: silence was not put in, the take is shorter
    std::uint64_t lost_messages = 0;
    std::uint64_t clipped = 0;  ///< samples beyond full scale
};

/// Of the control thread. Files grow in place and are whole at least once a second: killing the program loses
/// no more than that.
class LiveRecorder {
  public:
    /// The recording begins with the next block. The player must outlive the recorder.
    static Outcome<std::unique_ptr<LiveRecorder>> start(LivePlayer& player,
                                                        const RecordingSettings& settings);

    LiveRecorder(const LiveRecorder&) = delete;
    LiveRecorder& operator=(const LiveRecorder&) = delete;
    LiveRecorder(LiveRecorder&&) = delete;
    LiveRecorder& operator=(LiveRecorder&&) = delete;
    /// stop(), with its error lost.
    ~LiveRecorder();

    /// Ends the recording and completes its files. If the audio thread does not answer for a second (its
    /// device is gone), what it has delivered is kept. Returns the first error of the recording.
    MaybeError stop();

    [[nodiscard]] RecordingStatus status() const;
    /// What has gone wrong so far; the rest of the performance is then not written.
    [[nodiscard]] MaybeError failure() const;

  private:
    LiveRecorder(LivePlayer& player, std::optional<TakeSound> sound, std::optional<TakeMidi> midi);
    void run();
    /// Writes what the ring holds; true if that was anything.
    bool drain();
    void update_files();
    void note(const MaybeError& error);

    LivePlayer& player_;
    std::shared_ptr<CaptureRing> ring_;
    std::thread thread_;
    std::atomic<bool> stopping_{false};
    bool stopped_ = false;

    // Of the writing thread:
    std::optional<TakeSound> sound_;
    std::optional<TakeMidi> midi_;
    std::vector<StereoFrame> frames_;
    std::uint64_t popped_ = 0;

    std::atomic<std::uint64_t> written_frames_{0}, written_messages_{0}, clipped_{0};
    mutable std::mutex failure_mutex_;
    MaybeError failure_;
};

}  // namespace jawari::host
