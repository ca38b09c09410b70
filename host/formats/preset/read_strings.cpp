#include "formats/preset/read_strings.h"

#include "formats/preset/read_section.h"
#include "formats/scene/read_modes.h"

namespace jawari::host::preset {

namespace {

using json::Problems;
using json::Value;

std::vector<int> whole_semitones(Section& reader) {
    std::vector<int> semitones;
    for (const std::size_t value : reader.indices_or_empty("semitones", limits::frets))
        semitones.push_back(static_cast<int>(value));
    return semitones;
}

}  // namespace

FretsDescription read_frets(const Value& value, const std::string& path, Problems& problems) {
    Section reader(value, path, {"count", "semitones", "position_from_nut_m", "height_m", "restitution"},
                   problems);
    FretsDescription frets;
    if (reader.has("height_m")) frets.height_m = reader.numbers("height_m", limits::frets);
    if (reader.has("position_from_nut_m"))
        frets.position_from_nut_m = reader.numbers("position_from_nut_m", limits::frets);
    frets.semitones = whole_semitones(reader);
    frets.count = frets.height_m.size();
    if (reader.has("count") || frets.height_m.empty())
        frets.count = reader.whole_number("count", 0, limits::frets);
    frets.restitution = reader.number_or("restitution", frets.restitution);
    return frets;
}

InstrumentStringDescription read_string(const Value& value, const std::string& path, Problems& problems) {
    Section reader(value, path,
                   {"name", "open_note", "open_frequency_hz", "length_m", "linear_density_kg_per_m",
                    "inharmonicity", "damping", "level", "excitation", "pan", "course", "frets",
                    "exciter_place", "release_t60_s", "sympathetic"},
                   problems);
    InstrumentStringDescription string;
    string.name = reader.text("name");
    string.open_note = static_cast<int>(reader.whole_number("open_note", 0, 127));
    string.open_frequency_hz = reader.number("open_frequency_hz");
    string.length_m = reader.number("length_m");
    string.linear_density_kg_per_m = reader.number("linear_density_kg_per_m");
    string.inharmonicity = reader.number_or("inharmonicity", string.inharmonicity);
    if (const Value* damping = reader.require("damping", "an object")) {
        string.damping = read_damping(*damping, reader.path_of("damping"), problems);
    }
    string.level = reader.number_or("level", string.level);
    string.excitation = reader.number_or("excitation", string.excitation);
    string.pan = reader.number_or("pan", string.pan);
    if (reader.has("course"))
        string.course = reader.whole_number("course", 0, limits::instrument_strings - 1);
    if (const Value* frets = reader.find("frets"))
        string.frets = read_frets(*frets, reader.path_of("frets"), problems);
    if (const Value* place = reader.find("exciter_place"))
        string.exciter_place = read_place(*place, reader.path_of("exciter_place"), problems);
    string.release_t60_s = reader.number_or("release_t60_s", string.release_t60_s);
    string.sympathetic = reader.flag_or("sympathetic", string.sympathetic);
    return string;
}

}  // namespace jawari::host::preset
