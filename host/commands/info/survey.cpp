#include "commands/info/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/cpu_clock.h"
#include "jawari/instrument/render.h"

namespace jawari::host {

namespace {

double tension(const InstrumentStringDescription& string) {
    const double fundamental = string.open_frequency_hz / std::sqrt(1 + string.inharmonicity);
    const double speed = 2 * string.length_m * fundamental;
    return speed * speed * string.linear_density_kg_per_m;
}

StringSurvey survey_string(const InstrumentDescription& instrument, const InstrumentStringDescription& string,
                           const InstrumentStringModel& model) {
    const FretsDescription& frets = string.frets ? *string.frets : instrument.frets;
    StringSurvey survey;
    survey.name = string.name;
    survey.course = string.course;
    survey.open_note = string.open_note;
    survey.open_frequency_hz = string.open_frequency_hz;
    survey.length_m = string.length_m;
    survey.linear_density_kg_per_m = string.linear_density_kg_per_m;
    survey.tension_N = tension(string);
    survey.inharmonicity = string.inharmonicity;
    survey.frets = frets.count;
    const int rise = frets.semitones.empty() ? static_cast<int>(frets.count) : frets.semitones.back();
    survey.highest_note = string.open_note + rise;
    survey.modes = model.stopped.front().string.shape->mode_count;
    survey.contacts = model.stopped.front().string.shape->contact_count;
    return survey;
}

/// A note-on for the first string of each course: the others sound with it.
std::vector<InstrumentEvent> all_strings(const InstrumentDescription& instrument) {
    std::vector<InstrumentEvent> events;
    std::set<std::size_t> courses;
    for (std::size_t s = 0; s < instrument.strings.size(); ++s) {
        const InstrumentStringDescription& string = instrument.strings[s];
        if (string.course && !courses.insert(*string.course).second) continue;
        events.push_back(
            note_on_string(0, static_cast<int>(s), string.open_note, 1, static_cast<int>(s % midi_channels)));
    }
    return events;
}

double cost(const InstrumentModel& model, const std::vector<InstrumentEvent>& events) {
    InstrumentState state = make_instrument_state(model);
    std::array<double, 1024> left{}, right{};
    const auto blocks = static_cast<std::size_t>(std::ceil(model.output_rate_hz / left.size()));
    const double started = thread_cpu_s();
    for (std::size_t block = 0; block < blocks; ++block)
        render_instrument(
            model, state,
            block == 0 ? std::span<const InstrumentEvent>(events) : std::span<const InstrumentEvent>(),
            InstrumentOutput{left.data(), right.data(), {}}, left.size());
    const double sound_s = static_cast<double>(blocks * left.size()) / model.output_rate_hz;
    return (thread_cpu_s() - started) / sound_s;
}

}  // namespace

Outcome<PresetSurvey> survey_preset(const std::string& preset, const InstrumentSettings& settings) {
    InstrumentCache cache(settings);
    bool compiled = false;
    const auto loaded = cache.get(preset, compiled);
    if (!loaded) return loaded.error();
    const LoadedInstrument& instrument = *loaded.value();
    PresetSurvey survey;
    survey.preset = instrument.preset;
    survey.quality = name_of(settings.quality);
    survey.contact_rate_hz = instrument.model.contact_rate_hz;
    survey.cpu_compile_s = instrument.cpu_compile_s;
    const InstrumentDescription& description = instrument.preset.instrument;
    for (std::size_t s = 0; s < description.strings.size(); ++s) {
        const InstrumentStringModel& model = instrument.model.strings[s];
        survey.strings.push_back(survey_string(description, description.strings[s], model));
        survey.stopped_strings += model.stopped.size();
    }
    survey.cpu_all_strings = cost(instrument.model, all_strings(description));
    return survey;
}

std::string note_name(int note) {
    constexpr std::array<const char*, 12> names{"C",  "C#", "D",  "D#", "E",  "F",
                                                "F#", "G",  "G#", "A",  "A#", "B"};
    return names[static_cast<std::size_t>(note % 12)] + std::to_string(note / 12 - 1);
}

}  // namespace jawari::host
