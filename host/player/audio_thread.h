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
#include "jawari/instrument/render.h"
#include "jawari/realtime.h"
#include "midi/interpreter.h"
#include "player/block_clock.h"
#include "player/capture_ring.h"
#include "player/command.h"
#include "player/controller_memory.h"
#include "player/governor.h"
#include "player/midi_inlet.h"
#include "player/settings.h"
#include "player/staged_instrument.h"
#include "player/statistics.h"

namespace jawari::host {

/// Instruments that the audio thread may hold: waiting, playing, ringing out, given back.
inline constexpr std::size_t most_live_instruments = 16;

template <class T, std::size_t size>
using LiveQueue = boost::lockfree::spsc_queue<T, boost::lockfree::capacity<size>>;

/// What the audio thread shares with others.
struct LiveLinks {
    MidiInlet inlet;
    LiveQueue<LiveCommand, 1024> commands;                          ///< control -> audio
    LiveQueue<LiveInstrument*, most_live_instruments + 1> retired;  ///< audio -> control, never full
    LiveQueue<LiveNotice, 256> notices;                             ///< audio -> control
    LiveQueue<AppliedMessage, 4096> applied;                        ///< audio -> control
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

    /// For the end, when no audio thread is left: gives up everything it holds.
    void give_back_all() JAWARI_REALTIME;

  private:
    /// One plays, the others ring out.
    static constexpr std::size_t most_sounding = 4;
    /// Messages taken in a block; more wait for the next.
    static constexpr std::size_t most_messages = 1024;

    // audio_thread_stage.cpp
    void obey_commands() JAWARI_REALTIME;
    bool obey(const LiveCommand& command) JAWARI_REALTIME;
    bool panic() JAWARI_REALTIME;
    void call_on_stage(LiveInstrument* instrument) JAWARI_REALTIME;
    void take_stage() JAWARI_REALTIME;
    void fade(LiveInstrument& instrument, std::size_t frames) JAWARI_REALTIME;
    [[nodiscard]] double fade_frames() const JAWARI_REALTIME;
    void retire_silent() JAWARI_REALTIME;
    void start_capture(CaptureRing* ring) JAWARI_REALTIME;
    void stop_capture() JAWARI_REALTIME;

    // audio_thread.cpp
    void take_messages(std::size_t frames) JAWARI_REALTIME;
    void apply(const ChannelMessage& message, std::size_t offset) JAWARI_REALTIME;
    void count_ignored(const ChannelMessage& message) JAWARI_REALTIME;
    void add_event(InstrumentEvent event, std::size_t offset) JAWARI_REALTIME;
    void render(double* left, double* right, std::size_t begin, std::size_t frames) JAWARI_REALTIME;
    void follow_gain(std::size_t frames) JAWARI_REALTIME;
    void render_one(LiveInstrument& instrument, bool plays, std::size_t begin, std::size_t frames,
                    double* left, double* right) JAWARI_REALTIME;
    void capture(const double* left, const double* right, std::size_t frames) JAWARI_REALTIME;
    void end_capture() JAWARI_REALTIME;

    // audio_thread_quality.cpp
    void adapt_quality() JAWARI_REALTIME;

    // audio_thread_meters.cpp
    void measure_level(const double* left, const double* right, std::size_t frames) JAWARI_REALTIME;
    void measure_instruments() JAWARI_REALTIME;
    void survey_strings() JAWARI_REALTIME;
    void survey_string(LiveInstrument& instrument) JAWARI_REALTIME;
    void measure(std::size_t frames, std::int64_t started_ns) JAWARI_REALTIME;
    void notify(LiveNotice::Kind kind, double value) JAWARI_REALTIME;

    const LiveSettings settings_;
    LiveLinks& links_;
    MidiInterpreter interpreter_;
    MidiActions actions_;
    BlockClock clock_;
    std::uint64_t frame_ = 0;

    std::array<LiveInstrument*, most_sounding> stage_{};  // [0] plays, the others ring out, the oldest last
    std::size_t sounding_ = 0;
    LiveInstrument* waiting_ = nullptr;  // for a place on the stage
    std::uint64_t clock_origin_ = 0;     // frame_ at frame 0 of the instruments' states

    std::vector<InstrumentEvent> events_;  // of the block, in order; room is reserved
    std::vector<InstrumentEvent> chunk_;   // those of a part of the block, for one instrument

    double gain_ = 1;
    double gain_target_ = 1;
    double gain_rate_ = 0;       // per frame, while it moves
    std::vector<double> gains_;  // of the part of the block
    std::optional<Limiter> limiter_;

    ControllerMemory controllers_ = make_controller_memory();
    CaptureRing* capture_ = nullptr;
    std::uint64_t capture_begin_ = 0;    // frame_ at the recording's first frame
    std::size_t capture_skip_ = 0;       // frames of the limiter's delay still to be left out
    std::size_t capture_left_ = 0;       // of a recording that ends: frames still in the limiter's delay
    std::vector<StereoFrame> captured_;  // of the part of the block

    Governor governor_;
    std::size_t lowered_ = 0;  // strings below full quality
    double mean_load_ = 0;
    std::uint64_t nonfinite_resets_ = 0;
    InstrumentCounters retired_counters_;  // of instruments given back
    std::uint64_t retired_nonfinite_ = 0;
};

}  // namespace jawari::host
