// What is played: the player with its instrument, and everything that the control thread does to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "commands/play/options.h"
#include "instrument/instrument_cache.h"
#include "player/player.h"

namespace jawari::host {

class PlayControl {
  public:
    /// Reads every file that the options name and compiles the instrument. `frames`: of the device's blocks.
    /// `link`: to a window, outlives everything.
    static Outcome<std::unique_ptr<PlayControl>> create(const PlayOptions& options, double rate_hz,
                                                        std::size_t frames, StageLink& link);

    LivePlayer& player() { return player_; }
    [[nodiscard]] double rate_hz() const { return instruments_.output_rate_hz; }
    /// As it was asked for.
    [[nodiscard]] const std::string& preset() const { return preset_; }

    /// Compiles it, which may take a second, while the old one plays on.
    MaybeError play_preset(const std::string& preset);
    /// The same with what was compiled before, by settings().
    MaybeError play_compiled(const std::string& preset, const SharedInstrument& instrument);
    /// How instruments are compiled.
    [[nodiscard]] const InstrumentSettings& settings() const { return instruments_; }

    MaybeError set_parameter(ParameterId parameter, double value);
    MaybeError set_gain(double gain_db);
    MaybeError panic();
    /// A key without a keyboard, let go after `seconds` by tick().
    void note(int key, int velocity, double seconds, std::int64_t now_ns);
    /// Whether notes of note() are still down.
    [[nodiscard]] bool has_notes() const { return !notes_.empty(); }

    /// To be called every few milliseconds: ends notes, frees what the audio thread gave back.
    void tick(std::int64_t now_ns);

    /// The preset that a program change asked for; nothing if programs are not followed or have none.
    std::optional<std::string> asked_preset();

  private:
    struct TimedNote {
        int key = 0;
        std::int64_t end_ns = 0;
    };

    PlayControl(const LiveSettings& live, InstrumentSettings instruments)
        : instruments_(std::move(instruments)), guitar_(live.interpreter), player_(live) {}
    MaybeError send(const LiveCommand& command);
    MaybeError check_guitar(const InstrumentDescription& instrument) const;

    InstrumentSettings instruments_;
    InterpreterSettings guitar_;  ///< of the player, which cannot change them
    int guitar_channel_ = 0;      ///< 1 to 16; 0: no guitar mode
    bool follows_programs_ = false;
    std::string preset_;
    std::vector<TimedNote> notes_;
    LivePlayer player_;
    MidiPort* port_ = nullptr;  ///< for note()
};

}  // namespace jawari::host
