// A live session: audio, MIDI and control put together, and the commands that reach them. One thread, the
// control thread, calls everything here.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "commands/play/control.h"
#include "commands/play/options.h"
#include "commands/play/osc_server.h"
#include "commands/play/status_line.h"
#include "commands/play/verbs.h"
#include "devices/audio_link.h"
#include "devices/midi_inputs.h"
#include "player/recorder.h"

namespace jawari::host {

class Session {
  public:
    using Say = std::function<void(const std::string& line)>;

    /// `say`: shows one line to whoever plays.
    Session(PlayOptions options, Say say);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    ~Session();

    /// Everything is open and sounds when this comes back without an error.
    MaybeError open();

    Outcome<VerbReply> execute(const VerbCall& call);

    /// To be called every few milliseconds. An error ends the session.
    MaybeError tick();

    /// Set by `quit`; also ends a session that waits for its last notes.
    [[nodiscard]] bool wants_to_end() const { return quit_; }
    [[nodiscard]] bool has_notes() const { return control_ && control_->has_notes(); }

    /// Ends recordings, fades the sound out, ends devices. An error if a recording is not whole.
    MaybeError close();

    /// What the status line says now.
    StatusFacts status();

    /// Once it is open.
    PlayControl& control() { return *control_; }
    /// To a window.
    StageLink& link() { return *link_; }
    [[nodiscard]] bool sounds() const { return audio_.is_open(); }
    [[nodiscard]] const LiveStatistics& latest() const { return latest_; }

  private:
    MaybeError make_performance();
    MaybeError connect_midi();
    void await_first_block() const;
    MaybeError watch_audio(double now_s);
    MaybeError recover();
    [[nodiscard]] bool shares_server() const;
    void tell_notices();
    void follow_programs();
    void sample_statistics();

    void watch_recording();
    void tell(const Outcome<std::string>& line);
    [[nodiscard]] MaybeError check_recording(const std::string& sound, const std::string& midi) const;
    MaybeError start_recording(const std::string& sound, const std::string& midi, bool overwrite);
    Outcome<std::string> stop_recording();

    Outcome<VerbReply> set(const VerbCall& call);
    Outcome<VerbReply> get(const VerbCall& call) const;
    Outcome<VerbReply> note(const VerbCall& call);
    Outcome<VerbReply> record(const VerbCall& call);
    VerbReply stats();
    [[nodiscard]] std::vector<std::pair<std::string, std::uint64_t>> ignored() const;

    PlayOptions options_;
    Say say_;
    std::unique_ptr<StageLink> link_ = std::make_unique<StageLink>();
    AudioLink audio_;
    std::unique_ptr<PlayControl> control_;
    std::unique_ptr<LiveRecorder> recorder_;
    RecordingSettings recorded_;  ///< of the recorder, or of the last one
    std::unique_ptr<MidiInputs> midi_;
    LiveStatistics latest_;
    double peak_left_ = 0, peak_right_ = 0;  ///< since status() was asked before
    double worst_load_ = 0;
    double watched_s_ = 0, polled_s_ = 0, retried_s_ = 0;
    std::uint64_t told_drops_ = 0;
    bool monitor_ = false;
    bool quit_ = false;
};

/// Refuses options that contradict each other.
MaybeError check_options(const PlayOptions& options);

}  // namespace jawari::host
