#include "arguments.h"
#include "arrays.h"
#include "bind.h"
#include "errors.h"
#include "formats/scene/read_scene.h"
#include "formats/scene/words.h"

#include <pybind11/stl.h>

namespace jawari::python {

namespace py = pybind11;

namespace {

py::dict string_dict(StringFacts&& facts) {
    py::dict string;
    string["name"] = py::bytes(facts.name);
    string["length_m"] = facts.length_m;
    string["linear_density_kg_per_m"] = facts.linear_density_kg_per_m;
    string["contact_position_m"] = take(std::move(facts.contact_position_m));
    string["contact_height_m"] = take(std::move(facts.contact_height_m));
    string["contact_restitution"] = take(std::move(facts.contact_restitution));
    string["contact_side"] = facts.contact_side;
    string["contact_takes_part"] = take(std::move(facts.contact_takes_part));
    string["frequency_hz"] = take(std::move(facts.frequency_hz));
    string["decay_per_s"] = take(std::move(facts.decay_per_s));
    string["final_modal_displacement"] = take(std::move(facts.final_displacement));
    string["final_modal_velocity"] = take(std::move(facts.final_velocity));
    return string;
}

void add_rows(py::dict& string, host::StringRows&& rows, std::size_t count, std::size_t contacts) {
    const Shape per_contact{static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(contacts)};
    string["gap_m"] = take(std::move(rows.gap_m), per_contact);
    string["impulse_Ns"] = take(std::move(rows.impulse_Ns), per_contact);
    string["energy_J"] = take(std::move(rows.energy_J));
    if (rows.dissipated_J.empty()) return;
    string["dissipated_J"] = take(std::move(rows.dissipated_J));
    string["contact_work_J"] = take(std::move(rows.contact_work_J));
    string["player_work_J"] = take(std::move(rows.player_work_J));
}

py::dict recording_dict(Recording&& recording) {
    const auto count = static_cast<std::size_t>(recording.stats.rows);
    py::list names, units, probes, strings, warnings;
    std::vector<std::size_t> probe_strings;
    for (const host::ProbeLabel& label : recording.labels) {
        names.append(py::bytes(label.name));
        units.append(label.unit);
        probe_strings.push_back(label.string);
    }
    for (auto& probe : recording.probes) probes.append(take(std::move(probe)));
    for (std::size_t s = 0; s < recording.strings.size(); ++s) {
        const std::size_t contacts = recording.strings[s].contact_position_m.size();
        py::dict string = string_dict(std::move(recording.strings[s]));
        if (!recording.rows.empty()) add_rows(string, std::move(recording.rows[s]), count, contacts);
        strings.append(string);
    }
    for (const std::string& warning : recording.warnings) warnings.append(py::bytes(warning));
    py::dict result;
    result["stats"] = host::stats_json(recording.stats);
    result["rows"] = count;
    result["output_rate_hz"] = recording.stats.settings.output_rate_hz;
    result["probe_names"] = names;
    result["probe_units"] = units;
    result["probe_strings"] = probe_strings;
    result["probes"] = probes;
    result["strings"] = strings;
    result["warnings"] = warnings;
    return result;
}

py::dict simulate(const py::object& text, const std::string& name, const py::dict& settings) {
    host::Scene scene = scene_from(text, name);
    const RecordOptions options = record_options(settings);
    auto recording = [&] {
        const py::gil_scoped_release released;
        return record(std::move(scene), options, signal_poll());
    }();
    return recording_dict(value_or_raise(std::move(recording)));
}

/// Reads and compiles; the text that was read.
py::bytes check_scene(const py::object& text, const std::string& name, const py::dict& settings) {
    host::Scene scene = scene_from(text, name);
    std::string read = scene.text;
    RecordOptions options = record_options(settings);
    auto stepper = [&] {
        const py::gil_scoped_release released;
        return Stepper::create(std::move(scene), options);
    }();
    value_or_raise(std::move(stepper));
    return read;
}

}  // namespace

void bind_record(py::module_& module) {
    module.def("simulate", &simulate, py::arg("text"), py::arg("name"), py::arg("settings"));
    module.def("check_scene", &check_scene, py::arg("text"), py::arg("name"), py::arg("settings"));
    module.def("scene_text",
               [](const std::string& name) { return py::bytes(scene_from(py::none(), name).text); });
    module.def("scene_names", &host::builtin_scene_names);
}

}  // namespace jawari::python
