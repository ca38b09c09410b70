// The core of playing, without devices, files and threads: messages, parameters and notes, each stamped with
// a frame of the block, go in; samples come out; instruments take each other's place while they sound. What
// is rendered depends on the events and their frames alone, not on how frames are grouped into blocks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "jawari/instrument/render.h"
#include "jawari/realtime.h"
#include "midi/interpreter.h"
#include "stage/settings.h"
#include "stage/stage_link.h"
#include "stage/stage_watch.h"
#include "stage/staged_instrument.h"

namespace jawari::host {

/// Instruments that a stage may hold: waiting, playing, ringing out, given back.
inline constexpr std::size_t most_staged_instruments = 16;

/// Largest number of StageOutput::strings.
inline constexpr std::size_t most_string_channels = 16;

/// Where a stage renders to. Everything is overwritten.
struct StageOutput {
    double* left = nullptr;   ///< full scale is 1
    double* right = nullptr;  ///< full scale is 1
    /// Empty, or channels for what each string gives to the sound, without pan: string n plays on channel n,
    /// all that have none of their own on the last; at most most_string_channels. Needs
    /// StageSettings::string_outputs.
    std::span<double* const> strings;
};

/// One thread at a time may use it. Only its making allocates.
class Stage {
  public:
    explicit Stage(const StageSettings& settings);

    /// As given at the start. Threads: any.
    [[nodiscard]] const StageSettings& settings() const { return settings_; }

    // ---- events of the block, in the order of their frames

    /// Forgets the events of the block before.
    void begin_block() JAWARI_REALTIME { events_.clear(); }

    /// Whether the events of one more message have room. If not, render up to them and begin_block().
    [[nodiscard]] bool has_room() const JAWARI_REALTIME { return room() >= most_events_per_message; }
    /// Events that still have room.
    [[nodiscard]] std::size_t room() const JAWARI_REALTIME { return events_.capacity() - events_.size(); }

    /// What the message came to is added to the block's events; program changes are the caller's affair.
    /// Precondition: has_room(). The answer holds until the next message.
    const MidiActions& take(const ChannelMessage& message, std::size_t frame) JAWARI_REALTIME;

    /// A note that is no MIDI message: its velocity has more than 7 bits. channel: 0 to 15, key: 0 to 127,
    /// velocity: above 0, to 1. Precondition: has_room().
    void start_note(int channel, int key, double velocity, std::size_t frame) JAWARI_REALTIME;
    /// release: 0 to 1. Precondition: has_room().
    void release_note(int channel, int key, double release, std::size_t frame) JAWARI_REALTIME;
    /// Semitones by which the held note sounds above what it else would, -96 to 96. Precondition: has_room().
    void tune_note(int channel, int key, double semitones, std::size_t frame) JAWARI_REALTIME;

    /// Of all channels, in the parameter's unit; a value out of its range is ignored. Precondition:
    /// has_room().
    void set_parameter(ParameterId parameter, double value, std::size_t frame) JAWARI_REALTIME;

    /// Any other event, as it is. In guitar mode, notes beside the guitar's channels are left out and
    /// counted.
    void add(InstrumentEvent event, std::size_t frame) JAWARI_REALTIME;
    /// Notes left out so far.
    [[nodiscard]] std::uint64_t unplayed_notes() const JAWARI_REALTIME { return unplayed_notes_; }

    [[nodiscard]] std::span<const InstrumentEvent> events() const JAWARI_REALTIME { return events_; }
    [[nodiscard]] const MidiInterpreter& interpreter() const JAWARI_REALTIME { return interpreter_; }

    // ---- sound

    /// Renders the block's frames from `begin` on, at most StageSettings::most_frames at once. An event past
    /// the last of them takes effect with the part of the block that has it.
    void render(const StageOutput& output, std::size_t begin, std::size_t frames) JAWARI_REALTIME;

    /// Applies the block's events of frame `begin` and later without rendering anything.
    void apply_without_sound(std::size_t begin) JAWARI_REALTIME;

    /// Factor of everything, reached within 10 ms without a click.
    void set_gain(double gain) JAWARI_REALTIME;

    /// Frames rendered so far.
    [[nodiscard]] std::uint64_t frame() const JAWARI_REALTIME { return frame_; }

    // ---- instruments

    /// Takes the stage as soon as there is a place. One that still waits for it is given back unheard.
    void call(StagedInstrument* instrument) JAWARI_REALTIME;
    /// At the start of a block: whoever waits enters, if there is a place. Controllers, bends and parameters
    /// carry over. Events of the window count from here.
    void take_stage() JAWARI_REALTIME;
    /// At the end of a block: instruments that have rung out leave.
    void retire_silent() JAWARI_REALTIME;
    /// One that has left, null if there is none. The caller has it from here on.
    StagedInstrument* next_retired() JAWARI_REALTIME;
    /// Those that sound: the first plays, the others ring out, the oldest last.
    [[nodiscard]] std::span<StagedInstrument* const> sounding() const JAWARI_REALTIME {
        return {stage_.data(), sounding_};
    }
    /// Whether nothing sounds and nothing waits: rendering gives silence until the next event.
    [[nodiscard]] bool rests() const JAWARI_REALTIME;
    /// If the stage rests: time passes without rendering, with the same bits afterwards.
    void skip_silence(std::uint64_t frames) JAWARI_REALTIME;
    /// If nothing sounds: control frames and vibrato count from here, as from the start of a rendering.
    void restart_clock() JAWARI_REALTIME;

    /// As new, with the instrument that plays (or waits): silence, controllers as at the start, clock at 0.
    /// Others leave. What is rendered from then on has the bits of a new stage.
    void reset() JAWARI_REALTIME;
    /// Everybody leaves.
    void clear() JAWARI_REALTIME;

  private:
    /// One plays, the others ring out.
    static constexpr std::size_t most_sounding = 4;

    void add_actions(std::size_t frame) JAWARI_REALTIME;
    void take_window_events() JAWARI_REALTIME;
    void render_part(const StageOutput& output, std::size_t begin, std::size_t frames) JAWARI_REALTIME;
    void render_watched(const StageOutput& output, std::size_t begin, std::size_t frames) JAWARI_REALTIME;
    void retire(StagedInstrument* instrument) JAWARI_REALTIME;
    void follow_gain(std::size_t frames) JAWARI_REALTIME;
    void select_events(bool plays, std::size_t begin, std::size_t end) JAWARI_REALTIME;
    void render_one(StagedInstrument& instrument, bool plays, std::size_t begin, std::size_t frames,
                    const StageOutput& output) JAWARI_REALTIME;
    void add_strings(const StagedInstrument& instrument, std::size_t frames,
                     std::span<double* const> strings) JAWARI_REALTIME;
    void fade(StagedInstrument& instrument, std::size_t frames) JAWARI_REALTIME;
    [[nodiscard]] double fade_frames() const JAWARI_REALTIME;

    const StageSettings settings_;
    MidiInterpreter interpreter_;
    MidiInterpreter fresh_;  // interpreter_ as it was at the start
    MidiActions actions_;
    std::uint64_t frame_ = 0;
    std::uint64_t unplayed_notes_ = 0;

    std::array<StagedInstrument*, most_sounding> stage_{};
    std::size_t sounding_ = 0;
    StagedInstrument* waiting_ = nullptr;  // for a place on the stage
    std::uint64_t clock_origin_ = 0;       // frame_ at frame 0 of the instruments' states
    std::array<StagedInstrument*, most_staged_instruments> retired_{};
    std::size_t retired_count_ = 0;

    std::vector<InstrumentEvent> events_;  // of the block, in order; room is reserved
    std::vector<InstrumentEvent> chunk_;   // those of a part of the block, for one instrument

    StageWatch watch_;
    bool watched_ = false;  // while a window is open

    double gain_ = 1;
    double gain_target_ = 1;
    double gain_rate_ = 0;         // per frame, while it moves
    std::vector<double> gains_;    // of the part of the block
    std::vector<double> fadings_;  // likewise, of an instrument that is taken away
};

}  // namespace jawari::host
