// Recordings of a session.
#include <array>
#include <cmath>
#include <cstdio>

#include "base/file_plan.h"
#include "base/sound_file.h"
#include "base/text.h"
#include "commands/play/session.h"
#include "instrument/preset_library.h"

namespace jawari::host {

namespace {

std::string file_names(const RecordingSettings& settings) {
    const bool both = !settings.sound.empty() && !settings.midi.empty();
    return in_quotes(settings.sound) + (both ? " and " + in_quotes(settings.midi) : "");
}

std::string seconds(std::uint64_t frames, double rate_hz) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.1f s", static_cast<double>(frames) / rate_hz);
    return text.data();
}

}  // namespace

/// --force is for takes alone: what the performance was made from stays.
MaybeError Session::check_recording(const std::string& sound, const std::string& midi) const {
    if (!sound.empty() && container_of(sound) != SoundContainer::Wav)
        return usage_error("record", sound, "a name that ends in .wav: takes grow in place");
    FilePlan files(true);  // whether there may be an older take is the recorder's affair
    files.add_input("preset", preset_path(control_->preset()).value_or(""));
    add_inputs(options_.instrument, files);
    files.add_input("--config", options_.config.empty() ? default_config_path() : options_.config);
    if (auto error = files.add_output("record", sound, FileContent::Sound)) return error;
    return files.add_output("record", midi, FileContent::Midi);
}

MaybeError Session::start_recording(const std::string& sound, const std::string& midi, bool overwrite) {
    if (recorder_) return Error{ErrorKind::Usage, "record: a recording is under way; record stop ends it"};
    if (auto error = check_recording(sound, midi)) return error;
    RecordingSettings settings;
    settings.sound = sound;
    settings.midi = midi;
    settings.rate_hz = static_cast<std::uint32_t>(std::lround(control_->rate_hz()));
    settings.overwrite = overwrite;
    settings.tags = {"", "preset " + control_->preset()};
    auto recorder = LiveRecorder::start(control_->player(), settings);
    if (!recorder) return recorder.error();
    recorder_ = std::move(recorder.value());
    recorded_ = settings;
    return std::nullopt;
}

/// The line says what is in the files; an error, what is not.
Outcome<std::string> Session::stop_recording() {
    const auto failure = recorder_->stop();
    const RecordingStatus status = recorder_->status();
    recorder_.reset();
    if (failure) return *failure;
    std::string line = "recorded " + seconds(status.frames, recorded_.rate_hz) + ", " +
                       std::to_string(status.messages) + " MIDI messages, to " +
                       (recorded_.sound.empty() ? in_quotes(recorded_.midi) : file_names(recorded_));
    if (status.lost_frames + status.lost_messages > 0)
        line += "; lost " + std::to_string(status.lost_frames) + " frames and " +
                std::to_string(status.lost_messages) + " messages: the disk is too slow";
    if (status.clipped > 0) line += "; " + std::to_string(status.clipped) + " samples beyond full scale";
    return line;
}

void Session::watch_recording() {
    if (!recorder_) return;
    if (const auto failure = recorder_->failure()) {
        say_("warning: recording: " + failure->message);
        (void)recorder_->stop();
        recorder_.reset();
    }
}

Outcome<VerbReply> Session::record(const VerbCall& call) {
    if (text_of(call, 0) == "stop") {
        if (call.arguments.size() > 1)
            return usage_error("record stop", in_quotes(text_of(call, 1)), "no file");
        if (!recorder_) return Error{ErrorKind::Usage, "record stop: nothing is being recorded"};
        auto line = stop_recording();
        if (!line) return line.error();
        return VerbReply{{line.value()}, {}};
    }
    std::string sound;
    std::string midi;
    for (std::size_t i = 1; i < call.arguments.size(); ++i) {
        const std::string& path = text_of(call, i);
        const bool is_midi = lower_case(path).ends_with(".mid");
        if (!is_midi && !lower_case(path).ends_with(".wav"))
            return usage_error("record start", in_quotes(path), "names that end in .wav or .mid");
        std::string& target = is_midi ? midi : sound;
        if (!target.empty())
            return usage_error("record start", in_quotes(path), "one .wav and one .mid at most");
        target = path;
    }
    if (sound.empty() && midi.empty())
        return usage_error("record start", "no file", "FILE.wav, FILE.mid or both");
    if (auto error = start_recording(sound, midi, false)) return *error;
    return VerbReply{};
}

}  // namespace jawari::host
