#include "commands/play/session.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "base/platform.h"
#include "base/text.h"
#include "commands/play/monitor_text.h"

namespace jawari::host {

namespace {

constexpr double watch_period_s = 0.1;
constexpr double poll_period_s = 1;
constexpr double retry_period_s = 1;
/// Panic fades within 3 ms; a block or two must still reach the device.
constexpr double fade_out_s = 0.05;

double now_s() {
    return static_cast<double>(steady_clock_ns()) * 1e-9;
}

AudioWish audio_wish(const PlayOptions& options) {
    return {options.audio.value_or("auto"), options.audio_device.value_or(""),
            options.rate_hz.value_or(play_defaults::rate_hz), options.frames.value_or(play_defaults::frames),
            options.frames.has_value()};
}

void render_block(void* player, const AudioBlock& block) {
    auto& live = *static_cast<LivePlayer*>(player);
    if (block.after_gap) live.report_xrun();
    live.process(block.left, block.right, block.frames, block.now_ns);
}

std::string notice_text(const LiveNotice& notice) {
    switch (notice.kind) {
        case LiveNotice::Kind::OverloadLevel:
            return notice.value > 0 ? "warning: overload: quality lowered to step " + shortest(notice.value)
                                    : "notice: full quality again";
        case LiveNotice::Kind::NonfiniteReset:
            return "warning: " + shortest(notice.value) +
                   " strings were put to rest: their state was not finite";
        case LiveNotice::Kind::LostCapture:
            return "warning: the recording has lost " + shortest(notice.value) +
                   " frames: the disk is too slow";
    }
    return {};
}

void lock_memory(const Session::Say& say) {
    if (platform::lock_memory())
        say("memory: locked");
    else
        say(std::string("warning: memory is not locked: ") + std::strerror(errno) +
            " (docs/commands/play.md)");
}

}  // namespace

MaybeError check_options(const PlayOptions& options) {
    return check_dependencies(options.instrument,
                              options.preset.value_or(play_defaults::preset) == play_defaults::preset);
}

Session::Session(PlayOptions options, Say say)
    : options_(std::move(options)), say_(std::move(say)), audio_(audio_wish(options_), say_) {}

Session::~Session() {
    (void)close();
}

MaybeError Session::open() {
    if (auto error = audio_.open()) return error;
    if (auto error = make_performance()) return error;
    if (auto error = connect_midi()) return error;
    if (!options_.record.empty() || !options_.record_midi.empty()) {
        if (auto error = start_recording(options_.record, options_.record_midi, options_.overwrite))
            return error;
    }
    if (options_.lock_memory.value_or(false)) lock_memory(say_);
    if (auto error = audio_.start(&render_block, &control_->player())) return error;
    await_first_block();
    return std::nullopt;
}

/// So that the first command finds what the options set. A driver may be slow to begin; check() tells of it.
void Session::await_first_block() const {
    constexpr int most_waits = 50;
    for (int i = 0; i < most_waits && audio_.counters()->callbacks.load() == 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

MaybeError Session::make_performance() {
    const AudioFacts& facts = audio_.facts();
    auto control = PlayControl::create(options_, facts.rate_hz, facts.frames, *link_);
    if (!control) return control.error();
    control_ = std::move(control.value());
    monitor_ = options_.monitor.value_or(false);
    control_->player().set_monitor(monitor_);
    told_drops_ = 0;
    say_("preset: " + control_->preset());
    return std::nullopt;
}

MaybeError Session::connect_midi() {
    LivePlayer& player = control_->player();
    midi_ = std::make_unique<MidiInputs>(
        MidiWish{options_.midi.value_or("auto"), options_.midi_in.value_or(automatic_midi_in)},
        [&player] { return player.add_port(); }, say_);
    auto error = midi_->start();
    if (!error) return std::nullopt;
    const bool asked = options_.midi.value_or("auto") != "auto" ||
                       options_.midi_in.value_or(automatic_midi_in) != automatic_midi_in;
    if (asked) return error;
    // Without a word about MIDI, the shell and OSC can still play.
    say_("warning: " + error->message);
    return std::nullopt;
}

// ------------------------------------------------------------ from time to time

MaybeError Session::tick() {
    control_->tick(steady_clock_ns());
    tell_notices();
    follow_programs();
    const double now = now_s();
    if (now - watched_s_ >= watch_period_s) {
        watched_s_ = now;
        sample_statistics();
        watch_recording();
        if (auto error = watch_audio(now)) return error;
    }
    midi_->watch(steady_clock_ns());
    if (now - polled_s_ >= poll_period_s) {
        polled_s_ = now;
        midi_->poll();
    }
    return std::nullopt;
}

void Session::tell_notices() {
    LivePlayer& player = control_->player();
    while (const auto notice = player.notice()) say_(notice_text(*notice));
    while (const auto applied = player.applied())
        if (monitor_) say_(message_text(applied->message));
}

void Session::follow_programs() {
    const auto preset = control_->asked_preset();
    if (!preset) return;
    if (const auto error = control_->play_preset(*preset))
        say_("warning: " + error->message);
    else
        say_("preset: " + *preset);
}

void Session::sample_statistics() {
    latest_ = control_->player().statistics();
    peak_left_ = std::max(peak_left_, latest_.peak_left);
    peak_right_ = std::max(peak_right_, latest_.peak_right);
    worst_load_ = std::max(worst_load_, latest_.worst_load);
    if (latest_.dropped_messages > told_drops_) {
        say_("warning: " + std::to_string(latest_.dropped_messages - told_drops_) +
             " MIDI messages were lost");
        told_drops_ = latest_.dropped_messages;
    }
}

MaybeError Session::watch_audio(double now) {
    if (audio_.is_open()) {
        if (audio_.check(now) != StreamState::Lost) return std::nullopt;
        const std::string lost =
            "audio: " + audio_.facts().system + ": " + in_quotes(audio_.facts().device) + " is lost";
        if (!options_.retry.value_or(true)) return Error{ErrorKind::Device, lost};
        say_("warning: " + lost + "; looking for it every second");
        // The JACK library does not find a new server while a client of the old one is left.
        if (shares_server()) midi_->stop();
        retried_s_ = now;
        return std::nullopt;
    }
    if (now - retried_s_ < retry_period_s) return std::nullopt;
    retried_s_ = now;
    return recover();
}

bool Session::shares_server() const {
    return audio_.facts().system == "jack" && midi_->system() == "jack";
}

/// The player is kept, and with it what sounds, unless the device has come back with another rate.
MaybeError Session::recover() {
    if (!audio_.reopen()) return std::nullopt;
    if (audio_.facts().rate_hz != control_->rate_hz()) {
        midi_.reset();
        if (recorder_) tell(stop_recording());
        options_.preset = options_.preset.value_or(play_defaults::preset) == play_defaults::preset
                              ? options_.preset
                              : control_->preset();
        if (auto error = make_performance()) return error;
        if (auto error = connect_midi()) return error;
    } else if (shares_server()) {
        midi_->restart();
    }
    if (const auto error = audio_.start(&render_block, &control_->player()))
        say_("warning: " + error->message);
    return std::nullopt;
}

StatusFacts Session::status() {
    StatusFacts facts;
    facts.live = latest_;
    facts.live.peak_left = std::exchange(peak_left_, 0);
    facts.live.peak_right = std::exchange(peak_right_, 0);
    facts.preset = control_->preset();
    facts.worst_load = worst_load_;
    facts.audio_runs = audio_.is_open();
    if (recorder_) facts.recorded_s = static_cast<double>(recorder_->status().frames) / control_->rate_hz();
    return facts;
}

void Session::tell(const Outcome<std::string>& line) {
    say_(line ? line.value() : "warning: recording: " + line.error().message);
}

/// The recording ends before the fade: it is what was played, and its MIDI reproduces it.
MaybeError Session::close() {
    MaybeError failure;
    if (recorder_) {
        const auto line = stop_recording();
        if (line)
            say_(line.value());
        else
            failure = line.error();
    }
    if (control_ && audio_.is_open()) {
        (void)control_->panic();
        std::this_thread::sleep_for(std::chrono::duration<double>(fade_out_s));
    }
    audio_.close();
    midi_.reset();
    return failure;
}

}  // namespace jawari::host
