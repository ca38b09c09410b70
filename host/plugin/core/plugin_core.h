// One instance of the plugin, whatever the format: parameters, state, and sound block by block from events
// that are stamped with frames. Adapters (plugin/clap, plugin/vst3, plugin/lv2) translate what their hosts
// say.
#pragma once

#include <array>
#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "plugin/core/compile_state.h"
#include "plugin/core/note_register.h"
#include "plugin/core/plugin_state.h"
#include "stage/stage.h"

namespace jawari::host {

/// Channels of the output for single strings: string n plays on channel n, all beyond on the last.
inline constexpr std::size_t plugin_string_channels = 16;

/// After its last note an instrument is silent by then, as `jawari render` has it [s].
inline constexpr double plugin_tail_s = 60;

/// Where a block goes. Null: not wanted. Either the pointers to float or those to double of a channel.
struct PluginOutput {
    std::array<float*, 2> main{};
    std::array<double*, 2> main_64{};
    std::array<float*, plugin_string_channels> strings{};
    std::array<double*, plugin_string_channels> strings_64{};
};

/// Note expressions that the engine has.
enum class PluginExpression {
    Tuning,      ///< semitones above the key, -96 to 96
    Pressure,    ///< 0 to 1
    Brightness,  ///< 0 to 1, 0.5 is neutral: of the next plucks of the note's channel
    Volume,      ///< 0 to 4, 1 is neutral: factor of the note's sound
    Pan          ///< 0 (left) to 1 (right), 0.5 is neutral: added to the note's place
};

/// What compile_state() is to be asked for so that PluginCore::load_compiled() takes the answer.
struct CompileOrder {
    PluginState state;  ///< with the parameters in force; its preset may be replaced
    Quality quality = Quality::Live;
    double rate_hz = 48000;
    std::uint64_t loads = 0;  ///< by others, before
};

/// Threads: the control thread (the host's main thread) and the audio thread, each one at a time; both at
/// once. A call of the other section while inactive or between blocks is safe if the host orders the calls.
class PluginCore {
  public:
    PluginCore();
    /// Inactive, or no thread is inside any function.
    ~PluginCore();
    PluginCore(const PluginCore&) = delete;
    PluginCore& operator=(const PluginCore&) = delete;
    PluginCore(PluginCore&&) = delete;
    PluginCore& operator=(PluginCore&&) = delete;

    // ---- control thread. Everything here may allocate and compile; a failure changes nothing.

    /// The rate for which states are compiled before the first activate(): 48000 Hz unless told. One that
    /// activate() would refuse is not taken.
    void expect_rate(double rate_hz);

    /// Compiles for the rate (8000 to 384000 [Hz]) unless that has been done before, and makes room.
    MaybeError activate(double rate_hz);
    void deactivate();

    /// The state as text (plugin_state.h), with the parameters in force.
    [[nodiscard]] std::string save() const;
    /// From the next block on; what sounds rings out.
    MaybeError load(std::string_view text);
    MaybeError load(const PluginState& state);
    /// A preset's text, with all parameters neutral.
    MaybeError load_preset(const std::string& name, const std::string& text);
    /// A file that this instance takes up: a preset or a MIDI map (.json), a scale (.scl, .ascl), a keyboard
    /// map (.kbm), a tuning of all keys (.tun).
    MaybeError load_file(const std::string& path);

    /// For compiling a preset beside the control thread, while the state stays as it is.
    [[nodiscard]] CompileOrder compile_order() const;
    /// Rate, quality and everything but the preset are still what they were at compile_order().
    [[nodiscard]] bool fits(const CompileOrder& order) const;
    /// load() of what was compiled beforehand. Parameters that have changed meanwhile stay, unless the
    /// order's are neutral. Precondition: fits().
    MaybeError load_compiled(const CompileOrder& order, CompiledState compiled);
    /// Of the state, null before it is compiled.
    [[nodiscard]] const SharedInstrument& instrument() const { return compiled_.instrument; }

    /// Offline the state's offline quality is in force.
    MaybeError set_offline(bool offline);

    /// In force, in the parameter's unit. Threads: any.
    [[nodiscard]] double value(ParameterId parameter) const noexcept;
    /// From the next block on, inside its range; ignored if it is no finite number. Threads: any.
    void set_value(ParameterId parameter, double value) noexcept;

    /// Frees what the audio thread has given back.
    void collect();

    /// To a window of this instance.
    [[nodiscard]] StageLink& link() { return *link_; }

    [[nodiscard]] const PluginState& state() const { return state_; }
    /// Whether the state's model exists: not before a load or an activation.
    [[nodiscard]] bool compiled() const { return compiled_.instrument != nullptr; }

    // ---- audio thread, while active

    /// Silence, as after activate(); parameters keep their values.
    void reset() JAWARI_REALTIME;

    /// A block of any length, 0 too. `skipped`: frames that the host has left out since the block before
    /// because the instance rested.
    void begin_block(const PluginOutput& output, std::size_t frames, std::uint64_t skipped) JAWARI_REALTIME;

    // Events of the block, in the order of their frames; a frame before that of another is taken for the
    // other's, one past the end for the last.
    void take(const ChannelMessage& message, std::size_t frame) JAWARI_REALTIME;
    /// velocity: 0 to 1; 0 is a very soft note.
    void note_on(const NoteAddress& note, double velocity, std::size_t frame) JAWARI_REALTIME;
    /// Ends all that `which` may mean; of notes without an id on one key the oldest. release: 0 to 1.
    void note_off(const NoteAddress& which, double release, std::size_t frame) JAWARI_REALTIME;
    /// Everything at once if `which` names no key: its sound stops. A single note is let go fast.
    void choke(const NoteAddress& which, std::size_t frame) JAWARI_REALTIME;
    void express(PluginExpression expression, const NoteAddress& which, double value,
                 std::size_t frame) JAWARI_REALTIME;
    void set_parameter(ParameterId parameter, double value, std::size_t frame) JAWARI_REALTIME;

    /// Renders what is left of the block. True if the control thread should collect().
    bool end_block() JAWARI_REALTIME;

    /// Notes that have ended by the end of the block.
    std::span<const NoteAddress> ended_notes() JAWARI_REALTIME { return notes_.take_ended(); }
    /// Silence until the next event: the host need not call.
    [[nodiscard]] bool rests() const JAWARI_REALTIME;

  private:
    /// Frames rendered at once.
    static constexpr std::size_t chunk_frames = 256;

    using Buffer = std::array<double, chunk_frames>;

    [[nodiscard]] StageSettings stage_settings(double rate_hz) const;
    MaybeError put(const PluginState& state, bool offline, double rate_hz);
    void publish();
    std::unique_ptr<StagedInstrument> staged() const;

    std::size_t place(std::size_t frame) JAWARI_REALTIME;
    void render_until(std::size_t frame) JAWARI_REALTIME;
    void apply_rest() JAWARI_REALTIME;
    void copy_out(std::size_t frames) JAWARI_REALTIME;
    void enter_waiting() JAWARI_REALTIME;
    void follow_values() JAWARI_REALTIME;
    bool give_back() JAWARI_REALTIME;

    // Of the control thread:
    PluginState state_ = new_plugin_state();  // its parameters as loaded; values_ are in force
    bool offline_ = false;
    bool active_ = false;
    double rate_hz_ = 48000;
    CompiledState compiled_;  // of state_, at the two below; null: not yet
    double compiled_rate_hz_ = 0;
    std::uint64_t loads_ = 0;  // of states, but for load_compiled()
    Quality compiled_quality_ = Quality::Live;

    // Shared:
    std::unique_ptr<StageLink> link_;
    std::array<std::atomic<double>, parameter_count> values_{};
    std::atomic<StagedInstrument*> next_{nullptr};  // on its way to the stage
    boost::lockfree::spsc_queue<StagedInstrument*, boost::lockfree::capacity<most_staged_instruments + 1>>
        retired_;
    std::size_t published_ = 0;  // of the control thread: not yet collected

    // Of the audio thread:
    std::unique_ptr<Stage> stage_;
    NoteRegister notes_;
    std::array<double, parameter_count> applied_ = neutral_parameters();
    PluginOutput output_;
    bool with_strings_ = false;
    std::size_t frames_ = 0;    // of the block
    std::size_t rendered_ = 0;  // of them
    std::size_t latest_ = 0;    // frame of the latest event
    std::array<Buffer, 2> sound_{};
    std::array<Buffer, plugin_string_channels> string_sound_{};
};

}  // namespace jawari::host
