#include <string_view>

#include "base/input_file.h"
#include "base/platform.h"
#include "base/sound_file.h"
#include "base/suggestion.h"
#include "base/text.h"
#include "commands/play/options.h"
#include "devices/audio_devices.h"
#include "devices/midi_receiver.h"
#include "formats/json/object_reader.h"
#include "formats/json/parse.h"
#include "formats/words/parameter_words.h"
#include "formats/words/quality_words.h"

namespace jawari::host {

namespace {

using json::ObjectReader;
using json::Problems;

constexpr std::string_view schema = "jawari.play-config/1";
constexpr std::size_t longest_config_bytes = std::size_t{1} << 18U;

template <class T>
void prefer(std::optional<T>& own, const std::optional<T>& other) {
    if (!own) own = other;
}

void prefer(InstrumentOptions& own, const InstrumentOptions& other) {
    prefer(own.quality, other.quality);
    prefer(own.gain_db, other.gain_db);
    prefer(own.limiter_dbfs, other.limiter_dbfs);
    prefer(own.tuning, other.tuning);
    prefer(own.keyboard_map, other.keyboard_map);
    prefer(own.move_frets, other.move_frets);
    prefer(own.midi_map, other.midi_map);
    prefer(own.guitar_channel, other.guitar_channel);
    own.parameters.insert(own.parameters.begin(), other.parameters.begin(), other.parameters.end());
}

/// A text that is one of some words.
std::string word(ObjectReader& reader, std::string_view key, const std::vector<std::string>& allowed) {
    std::string text = reader.text(key);
    for (const std::string& each : allowed)
        if (each == text) return text;
    reader.problems().add(reader.path_of(key), in_quotes(text) + did_you_mean(text, allowed), join(allowed));
    return text;
}

std::vector<std::string> with_auto(std::vector<std::string> words) {
    words.insert(words.begin(), "auto");
    return words;
}

std::string name(ObjectReader& reader, std::string_view key) {
    std::string text = reader.text(key);
    if (text.empty()) reader.problems().add(reader.path_of(key), in_quotes(text), "a name");
    return text;
}

std::uint32_t whole(ObjectReader& reader, std::string_view key, std::size_t lowest, std::size_t highest) {
    return static_cast<std::uint32_t>(reader.whole_number(key, lowest, highest));
}

void read_devices(ObjectReader& reader, PlayOptions& options) {
    if (reader.has("preset")) options.preset = name(reader, "preset");
    if (reader.has("fixed_quality")) options.fixed_quality = reader.flag("fixed_quality");
    if (reader.has("audio")) options.audio = word(reader, "audio", with_auto(audio_system_words()));
    if (reader.has("audio_device")) options.audio_device = name(reader, "audio_device");
    if (reader.has("midi")) options.midi = word(reader, "midi", with_auto(midi_system_words()));
    if (reader.has("midi_in")) options.midi_in = name(reader, "midi_in");
    if (reader.has("rate_hz"))
        options.rate_hz = whole(reader, "rate_hz", lowest_render_rate_hz, highest_render_rate_hz);
    if (reader.has("frames"))
        options.frames = whole(reader, "frames", lowest_play_frames, highest_play_frames);
    if (reader.has("retry")) options.retry = reader.flag("retry");
    if (reader.has("lock_memory")) options.lock_memory = reader.flag("lock_memory");
}

void read_instrument(ObjectReader& reader, InstrumentOptions& instrument) {
    if (reader.has("quality"))
        instrument.quality =
            reader.choice<Quality>("quality", {{name_of(Quality::Live), Quality::Live},
                                               {name_of(Quality::Studio), Quality::Studio},
                                               {name_of(Quality::Reference), Quality::Reference}});
    if (reader.has("gain_db")) instrument.gain_db = reader.number("gain_db", {-120, 60});
    if (reader.has("limiter_dbfs")) instrument.limiter_dbfs = reader.number("limiter_dbfs", {-40, 0});
    if (reader.has("tuning")) instrument.tuning = name(reader, "tuning");
    if (reader.has("keyboard_map")) instrument.keyboard_map = name(reader, "keyboard_map");
    if (reader.has("move_frets")) instrument.move_frets = reader.flag("move_frets");
    if (reader.has("midi_map")) instrument.midi_map = name(reader, "midi_map");
    if (reader.has("guitar_channel"))
        instrument.guitar_channel = static_cast<int>(whole(reader, "guitar_channel", 1, 16));
}

void read_control(ObjectReader& reader, PlayOptions& options) {
    if (reader.has("osc_port"))
        options.osc_port = static_cast<std::uint16_t>(whole(reader, "osc_port", 1, 65535));
    if (reader.has("osc_host")) options.osc_host = name(reader, "osc_host");
    if (reader.has("shell")) options.shell = reader.flag("shell");
    if (reader.has("monitor")) options.monitor = reader.flag("monitor");
}

void read_parameters(ObjectReader& reader, InstrumentOptions& instrument) {
    const json::Value* value = reader.find("parameters");
    if (value == nullptr) return;
    std::vector<std::string_view> keys;
    for (const ParameterDeclaration& each : parameter_table()) keys.push_back(each.key);
    ObjectReader parameters(*value, reader.path_of("parameters"), keys, reader.problems());
    for (const ParameterDeclaration& each : parameter_table())
        if (parameters.has(each.key))
            instrument.parameters.emplace_back(each.id, parameters.number(each.key, {each.low, each.high}));
}

}  // namespace

PlayOptions merge(PlayOptions own, const PlayOptions& other) {
    prefer(own.preset, other.preset);
    prefer(own.audio, other.audio);
    prefer(own.audio_device, other.audio_device);
    prefer(own.midi, other.midi);
    prefer(own.midi_in, other.midi_in);
    prefer(own.rate_hz, other.rate_hz);
    prefer(own.frames, other.frames);
    prefer(own.fixed_quality, other.fixed_quality);
    prefer(own.instrument, other.instrument);
    prefer(own.osc_port, other.osc_port);
    prefer(own.osc_host, other.osc_host);
    prefer(own.shell, other.shell);
    prefer(own.monitor, other.monitor);
    prefer(own.retry, other.retry);
    prefer(own.lock_memory, other.lock_memory);
    return own;
}

std::string default_config_path() {
    const std::string base = platform::user_folder(platform::UserFolder::Configuration);
    return base.empty() ? base : base + "/jawari/play.json";
}

Outcome<PlayOptions> read_play_config(const std::string& text, const std::string& file) {
    const auto document = json::parse(text, file);
    if (!document) return document.error();
    Problems problems;
    ObjectReader reader(
        document.value(), "",
        {"schema",   "preset",       "audio",      "audio_device",  "midi",           "midi_in",
         "rate_hz",  "frames",       "quality",    "fixed_quality", "gain_db",        "limiter_dbfs",
         "tuning",   "keyboard_map", "move_frets", "midi_map",      "guitar_channel", "parameters",
         "osc_port", "osc_host",     "shell",      "monitor",       "retry",          "lock_memory"},
        problems);
    reader.choice<int>("schema", {{schema, 1}});
    PlayOptions options;
    read_devices(reader, options);
    read_instrument(reader, options.instrument);
    read_control(reader, options);
    read_parameters(reader, options.instrument);
    if (problems.any()) return invalid_input(file, *problems.first());
    return options;
}

Outcome<PlayOptions> with_config_file(PlayOptions options) {
    const std::string path = options.config.empty() ? default_config_path() : options.config;
    if (path.empty() || (options.config.empty() && !path_exists(path))) return options;
    const auto text = read_file(path, longest_config_bytes);
    if (!text) return text.error();
    const auto file = read_play_config(text.value(), path);
    if (!file) return file.error();
    return merge(std::move(options), file.value());
}

}  // namespace jawari::host
