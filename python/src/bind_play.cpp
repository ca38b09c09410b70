#include <pybind11/stl.h>

#include <cmath>
#include <map>

#include "arrays.h"
#include "base/sound_file.h"
#include "base/text.h"
#include "bind.h"
#include "errors.h"
#include "formats/preset/read_preset.h"
#include "formats/words/parameter_words.h"
#include "formats/words/quality_words.h"
#include "instrument/instrument_cache.h"
#include "instrument/preset_library.h"
#include "playing.h"

namespace jawari::python {

namespace py = pybind11;

namespace {

void check_range(const char* name, double value, double lowest, double highest) {
    if (value >= lowest && value <= highest) return;
    raise(host::usage_error(name, host::shortest(value),
                            host::shortest(lowest) + " to " + host::shortest(highest)));
}

std::uint32_t rate_of(const py::dict& settings) {
    const double rate = settings["rate"].cast<double>();
    check_range("rate", rate, host::lowest_render_rate_hz, host::highest_render_rate_hz);
    if (rate != std::floor(rate)) raise(host::usage_error("rate", host::shortest(rate), "whole numbers"));
    return static_cast<std::uint32_t>(rate);
}

host::RenderOptions render_options(const py::dict& settings) {
    host::RenderOptions options;
    options.rate_hz = rate_of(settings);
    options.instrument.gain_db = settings["gain_db"].cast<double>();
    check_range("gain_db", *options.instrument.gain_db, -200, 200);
    if (!settings["tail_s"].is_none()) {
        options.tail_s = settings["tail_s"].cast<double>();
        check_range("tail_s", *options.tail_s, 0, host::longest_tail_s);
    }
    if (!settings["seed"].is_none()) options.seed = settings["seed"].cast<std::uint64_t>();
    if (!settings["limiter_dbfs"].is_none()) {
        options.instrument.limiter_dbfs = settings["limiter_dbfs"].cast<double>();
        check_range("limiter_dbfs", *options.instrument.limiter_dbfs, -40, 0);
    }
    const auto words = host::quality_words();
    const auto quality = words.find(settings["quality"].cast<std::string>());
    if (quality == words.end())
        raise(host::usage_error("quality", host::in_quotes(settings["quality"].cast<std::string>()),
                                "live, reference, studio"));
    options.instrument.quality = quality->second;
    return options;
}

TimedMessage message_of(const py::handle& event) {
    const auto pair = event.cast<std::pair<double, py::object>>();
    std::vector<int> bytes;
    for (const py::handle byte : py::reinterpret_borrow<py::iterable>(pair.second))
        bytes.push_back(byte.cast<int>());
    constexpr double latest_s = static_cast<double>(host::max_midi_duration_s);
    check_range("time of an event", pair.first, 0, latest_s);
    std::string text;
    for (const int byte : bytes) text += (text.empty() ? "" : " ") + std::to_string(byte);
    const bool program = !bytes.empty() && (bytes[0] & 0xE0) == 0xC0;  // and channel pressure: one data byte
    bool good = bytes.size() == (program ? 2U : 3U) && bytes[0] >= 0x80 && bytes[0] < 0xF0;
    for (std::size_t i = 1; good && i < bytes.size(); ++i) good = bytes[i] >= 0 && bytes[i] < 128;
    if (!good)
        raise(host::usage_error("message of an event", text,
                                "a channel message: status 128 to 239, then one or two bytes of 0 to 127"));
    const auto byte = [&bytes](std::size_t i) {
        return static_cast<std::uint8_t>(i < bytes.size() ? bytes[i] : 0);
    };
    return {pair.first, byte(0), byte(1), byte(2)};
}

host::MidiFile music_of(const py::object& music, const std::string& name, std::uint32_t rate_hz) {
    if (py::isinstance<py::bytes>(music)) {
        const auto bytes = music.cast<std::string>();
        auto file = [&] {
            const py::gil_scoped_release released;
            return read_midi(bytes, name);
        }();
        return value_or_raise(std::move(file));
    }
    std::vector<TimedMessage> messages;
    for (const py::handle event : py::reinterpret_borrow<py::iterable>(music))
        messages.push_back(message_of(event));
    return as_midi(std::move(messages), rate_hz);
}

/// The samples, (frames, 2), and the notices.
py::tuple render(const py::object& music, const std::string& music_name, const py::object& preset_text,
                 const std::string& preset_name, const py::dict& settings) {
    const host::RenderOptions options = render_options(settings);
    PresetSource preset{preset_name, {}};
    if (!preset_text.is_none()) preset.text = preset_text.cast<std::string>();
    const host::MidiFile file = music_of(music, music_name, options.rate_hz);
    auto outcome = [&] {
        const py::gil_scoped_release released;
        return play(file, preset, options, signal_poll());
    }();
    Played played = value_or_raise(std::move(outcome));
    py::list notices;
    for (const std::string& line : played.notices) notices.append(py::bytes(line));
    const auto frames = static_cast<py::ssize_t>(played.sound.size() / 2);
    return py::make_tuple(take(std::move(played.sound), {frames, 2}), notices);
}

py::bytes preset_text(const std::string& name) {
    return value_or_raise(host::preset_text(name));
}

void check_preset(const std::string& text, const std::string& name) {
    auto compiled = [&] {
        const py::gil_scoped_release released;
        return host::compile_preset_text(text, name, {});
    }();
    value_or_raise(std::move(compiled));
}

}  // namespace

void bind_play(py::module_& module) {
    module.def("render", &render, py::arg("music"), py::arg("music_name"), py::arg("preset_text"),
               py::arg("preset_name"), py::arg("settings"));
    module.def("preset_text", &preset_text, py::arg("name"));
    module.def("check_preset", &check_preset, py::arg("text"), py::arg("name"));
    module.def("preset_names", [] {
        std::vector<std::string> names;
        for (const host::NamedPreset& preset : host::named_presets()) names.push_back(preset.name);
        return names;
    });
}

}  // namespace jawari::python
