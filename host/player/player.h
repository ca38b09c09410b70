// Playing live, without a device: MIDI and commands go in at any time, sound is asked for block by block.
// What the threads share are queues of fixed size, atomic numbers and models that never change; the audio
// thread takes no lock, no memory and makes no system call (docs/player/player.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "instrument/instrument_cache.h"
#include "jawari/parameters.h"
#include "jawari/realtime.h"
#include "midi/interpreter.h"
#include "player/capture_ring.h"
#include "player/command.h"
#include "player/midi_port.h"
#include "player/settings.h"
#include "player/statistics.h"

namespace jawari::host {

/// Threads: the control thread is whichever calls the functions of its section, one at a time (the caller's
/// affair); each MidiPort has one pushing thread; process() has one thread at a time.
class LivePlayer {
  public:
    explicit LivePlayer(const LiveSettings& settings);
    /// No thread may be inside any function.
    ~LivePlayer();
    LivePlayer(const LivePlayer&) = delete;
    LivePlayer& operator=(const LivePlayer&) = delete;
    LivePlayer(LivePlayer&&) = delete;
    LivePlayer& operator=(LivePlayer&&) = delete;

    // ---- control thread

    /// A queue for one more thread that brings MIDI; null beyond MidiInlet::most_ports. Lives as long as the
    /// player.
    MidiPort* add_port();

    /// The instrument that plays from the next block on; compiled for the player's rate. The one before rings
    /// out: it hears note-offs, bends and pedals, but no new notes. Controllers, bends and parameters carry
    /// over. False if too many changes wait for the audio thread: collect() and try again.
    bool publish(const SharedInstrument& instrument);

    /// SetParameter, SetGain (0 to 1e6) or Panic. False if the queue is full, or a value is out of its range.
    bool send(const LiveCommand& command);

    /// What is played from the next block on goes into the ring, until stop_capture(), the end of the player,
    /// or another start. A performance at rest starts anew with frame 0 of the recording, so that its
    /// messages alone reproduce it. False if the queue is full.
    bool start_capture(std::shared_ptr<CaptureRing> ring);
    bool stop_capture();

    /// Frees what the audio thread has given back. To be called often (every 10 to 50 ms).
    void collect();

    /// The latest program change that came over MIDI since this was asked before.
    std::optional<ProgramRequest> program_request();

    /// The next thing to tell the player, oldest first.
    std::optional<LiveNotice> notice();

    /// The next applied message, oldest first, if a monitor is on; when nobody asks, messages are left out.
    void set_monitor(bool on) noexcept;
    std::optional<AppliedMessage> applied();

    LiveStatistics statistics();

    /// In force on the channel, 0 to 15, in the parameter's unit.
    [[nodiscard]] double parameter(ParameterId id, int channel = 0) const noexcept;

    /// The instrument published last, or null.
    [[nodiscard]] const SharedInstrument& instrument() const noexcept;

    /// Frames by which sound is late beyond the block in which its event came in: the limiter's.
    [[nodiscard]] std::size_t latency_frames() const noexcept;

    // ---- audio system's threads

    /// The audio system lost a block.
    void report_xrun() noexcept;

    /// Renders `frames` samples, full scale 1. now_ns: settings.clock at the call, on which MIDI is timed
    /// too.
    void process(double* left, double* right, std::size_t frames, std::int64_t now_ns) JAWARI_REALTIME;

  private:
    struct Shared;
    std::unique_ptr<Shared> shared_;
};

}  // namespace jawari::host
