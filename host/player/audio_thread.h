// The audio thread's side of live playing: takes commands and messages, renders, gives back.
#pragma once

#include <array>
#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "instrument/limiter.h"
#include "jawari/instrument/expected_notes.h"
#include "jawari/instrument/render.h"
#include "jawari/realtime.h"
#include "player/block_clock.h"
#include "player/capture_ring.h"
#include "player/command.h"
#include "player/controller_memory.h"
#include "player/governor.h"
#include "player/midi_inlet.h"
#include "player/settings.h"
#include "player/statistics.h"
#include "stage/stage.h"

namespace jawari::host {

template <class T, std::size_t size>
using LiveQueue = boost::lockfree::spsc_queue<T, boost::lockfree::capacity<size>>;

/// What the audio thread shares with others.
struct LiveLinks {
    MidiInlet inlet;
    LiveQueue<LiveCommand, 1024> commands;                              ///< control -> audio
    LiveQueue<StagedInstrument*, most_staged_instruments + 1> retired;  ///< audio -> control, never full
    LiveQueue<LiveNotice, 256> notices;                                 ///< audio -> control
    LiveQueue<AppliedMessage, 4096> applied;                            ///< audio -> control
    std::atomic<bool> monitor{false};
    std::atomic<std::uint32_t> program{0};  ///< packed ProgramRequest; 0: none
    LiveMeters meters;
};

std::uint32_t pack(const ProgramRequest& request) JAWARI_REALTIME;

class AudioThread {
  public:
    /// Both must outlive it.
    AudioThread(const LiveSettings& settings, LiveLinks& links);

    void process(double* left, double* right, std::size_t frames, std::int64_t now_ns) JAWARI_REALTIME;

    [[nodiscard]] std::size_t limiter_frames() const { return limiter_ ? limiter_->look_ahead : 0; }

    /// What instruments are made for. Threads: any.
    [[nodiscard]] const StageSettings& stage_settings() const { return stage_.settings(); }

    /// For the end, when no audio thread is left: gives up everything it holds.
    void give_back_all() JAWARI_REALTIME;

  private:
    /// Messages taken in a block; more wait for the next.
    static constexpr std::size_t most_messages = 1024;

    // audio_thread_commands.cpp
    void obey_commands() JAWARI_REALTIME;
    bool obey(const LiveCommand& command) JAWARI_REALTIME;
    bool panic() JAWARI_REALTIME;
    void give_back_retired() JAWARI_REALTIME;
    void start_capture(CaptureRing* ring) JAWARI_REALTIME;
    void stop_capture() JAWARI_REALTIME;

    // audio_thread.cpp
    void take_messages(std::size_t frames) JAWARI_REALTIME;
    void apply(const ChannelMessage& message, std::size_t offset) JAWARI_REALTIME;
    void count_ignored(const ChannelMessage& message) JAWARI_REALTIME;
    void show_parameters(std::size_t first) JAWARI_REALTIME;
    void render(double* left, double* right, std::size_t begin, std::size_t frames) JAWARI_REALTIME;
    void capture(const double* left, const double* right, std::size_t frames) JAWARI_REALTIME;
    void end_capture() JAWARI_REALTIME;

    // audio_thread_quality.cpp
    std::size_t foresee_notes(std::size_t frames) JAWARI_REALTIME;
    void adapt_quality(std::size_t changes) JAWARI_REALTIME;

    // audio_thread_meters.cpp
    void measure_level(const double* left, const double* right, std::size_t frames) JAWARI_REALTIME;
    void measure_instruments() JAWARI_REALTIME;
    void survey_strings() JAWARI_REALTIME;
    void survey_string(StagedInstrument& instrument) JAWARI_REALTIME;
    void measure(std::size_t frames, std::int64_t started_ns) JAWARI_REALTIME;
    void tell_level() JAWARI_REALTIME;
    void notify(LiveNotice::Kind kind, double value) JAWARI_REALTIME;

    const LiveSettings settings_;
    LiveLinks& links_;
    BlockClock clock_;
    Stage stage_;
    std::optional<Limiter> limiter_;

    ControllerMemory controllers_ = make_controller_memory();
    CaptureRing* capture_ = nullptr;
    std::uint64_t capture_begin_ = 0;    // stage_.frame() at the recording's first frame
    std::size_t capture_skip_ = 0;       // frames of the limiter's delay still to be left out
    std::size_t capture_left_ = 0;       // of a recording that ends: frames still in the limiter's delay
    std::vector<StereoFrame> captured_;  // of the part of the block

    Governor governor_;
    std::size_t lowered_ = 0;                                              // strings below full quality
    std::array<ExpectedNote, 2 * limits::instrument_strings> expected_{};  // notes of the block
    double note_work_ = 0;  // of these, as they begin [multiply-adds of FrameCost]
    double mean_load_ = 0;
    std::uint64_t nonfinite_resets_ = 0;
    InstrumentCounters retired_counters_;  // of instruments given back
    std::uint64_t retired_nonfinite_ = 0;
};

}  // namespace jawari::host
