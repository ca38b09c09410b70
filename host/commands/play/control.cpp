#include "commands/play/control.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "base/decibels.h"
#include "base/text.h"
#include "cli/instrument_options.h"
#include "instrument/preset_library.h"
#include "instrument/program_presets.h"
#include "midi/guitar_mode.h"

namespace jawari::host {

namespace {

constexpr std::uint8_t medium_release = 64;

std::string first_preset(const PlayOptions& options) {
    const std::string preset = options.preset.value_or(play_defaults::preset);
    return preset == play_defaults::preset ? play_defaults::first_preset : preset;
}

Outcome<LiveSettings> live_settings(const PlayOptions& options, const InstrumentDescription& instrument,
                                    double rate_hz, std::size_t frames) {
    LiveSettings settings;
    settings.rate_hz = rate_hz;
    settings.most_frames = frames;
    settings.gain = factor_of(options.instrument.gain_db.value_or(0));
    settings.limiter_dbfs = options.instrument.limiter_dbfs;
    settings.overload.enabled = !options.fixed_quality.value_or(false);
    if (auto error = set_interpreter(options.instrument, settings.interpreter)) return *error;
    const int channel = guitar_channel(options.instrument, instrument);
    if (channel > 0) {
        if (auto error = set_guitar_mode(instrument, channel - 1, settings.interpreter)) return *error;
    }
    return settings;
}

}  // namespace

Outcome<std::unique_ptr<PlayControl>> PlayControl::create(const PlayOptions& options, double rate_hz,
                                                          std::size_t frames, StageLink& link) {
    auto instruments = instrument_settings(options.instrument, rate_hz);
    if (!instruments) return instruments.error();
    instruments.value().lower_qualities = !options.fixed_quality.value_or(false);
    const auto preset = load_with(first_preset(options), instruments.value());
    if (!preset) return preset.error();
    auto live = live_settings(options, preset.value().instrument, rate_hz, frames);
    if (!live) return live.error();
    live.value().link = &link;

    std::unique_ptr<PlayControl> control(new PlayControl(live.value(), std::move(instruments.value())));
    control->guitar_channel_ = guitar_channel(options.instrument, preset.value().instrument);
    control->follows_programs_ = options.preset.value_or(play_defaults::preset) == play_defaults::preset;
    control->port_ = control->player_.add_port();
    if (auto error = control->play_preset(first_preset(options))) return *error;
    for (const auto& [parameter, value] : engine_parameters(options.instrument)) {
        if (auto error = control->set_parameter(parameter, value)) return *error;
    }
    return control;
}

/// The interpreter's strings are fixed when the player is made.
MaybeError PlayControl::check_guitar(const InstrumentDescription& instrument) const {
    if (guitar_channel_ == 0) return std::nullopt;
    InterpreterSettings wanted = guitar_;
    if (auto error = set_guitar_mode(instrument, guitar_channel_ - 1, wanted)) return error;
    if (wanted.guitar_strings == guitar_.guitar_strings && wanted.guitar_string == guitar_.guitar_string)
        return std::nullopt;
    return Error{ErrorKind::Usage, "guitar mode: the strings are others; start jawari play with this preset"};
}

MaybeError PlayControl::play_preset(const std::string& preset) {
    const auto instrument = load_and_compile(preset, instruments_);
    if (!instrument) return instrument.error();
    return play_compiled(preset, instrument.value());
}

MaybeError PlayControl::play_compiled(const std::string& preset, const SharedInstrument& instrument) {
    if (auto error = check_guitar(instrument->preset.instrument)) return error;
    constexpr int most_attempts = 100;
    for (int attempt = 0; !player_.publish(instrument); ++attempt) {
        if (attempt == most_attempts) return Error{ErrorKind::Device, "the audio thread takes no instrument"};
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        player_.collect();
    }
    preset_ = preset;
    return std::nullopt;
}

MaybeError PlayControl::send(const LiveCommand& command) {
    if (player_.send(command)) return std::nullopt;
    return Error{ErrorKind::Device, "the audio thread takes no more commands"};
}

MaybeError PlayControl::set_parameter(ParameterId parameter, double value) {
    if (parameter == ParameterId::BendRange)
        return Error{ErrorKind::Usage, "bend_range: set by RPN 0, or --set when jawari play starts"};
    LiveCommand command;
    command.kind = LiveCommand::Kind::SetParameter;
    command.parameter = parameter;
    command.value = value;
    return send(command);
}

MaybeError PlayControl::set_gain(double gain_db) {
    LiveCommand command;
    command.kind = LiveCommand::Kind::SetGain;
    command.value = factor_of(gain_db);
    return send(command);
}

MaybeError PlayControl::panic() {
    notes_.clear();
    LiveCommand command;
    command.kind = LiveCommand::Kind::Panic;
    return send(command);
}

void PlayControl::note(int key, int velocity, double seconds, std::int64_t now_ns) {
    const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
    port_->push({{byte(static_cast<int>(MessageKind::NoteOn)), byte(key), byte(velocity)}, 0});
    notes_.push_back({key, now_ns + std::llround(seconds * 1e9)});
}

void PlayControl::tick(std::int64_t now_ns) {
    const auto is_over = [&](const TimedNote& note) { return note.end_ns <= now_ns; };
    for (const TimedNote& note : notes_)
        if (is_over(note))
            port_->push({{static_cast<std::uint8_t>(MessageKind::NoteOff),
                          static_cast<std::uint8_t>(note.key), medium_release},
                         0});
    std::erase_if(notes_, is_over);
    player_.collect();
}

std::optional<std::string> PlayControl::asked_preset() {
    const auto request = player_.program_request();
    if (!request || !follows_programs_ || request->unpitched) return std::nullopt;
    const auto preset = program_preset(request->bank, request->program);
    if (!preset || *preset == preset_ || !preset_exists(std::string(*preset))) return std::nullopt;
    return std::string(*preset);
}

}  // namespace jawari::host
