#include "commands/simulate/hdf5_output.h"

#include <array>
#include <cerrno>
#include <numeric>
#include <string>
#include <utility>

#include "commands/simulate/hdf5_handle.h"
#include "formats/scene/words.h"
#include "jawari/version.h"

namespace jawari::host {

using hdf5::Extent;
using hdf5::Handle;
using hdf5::set_attribute;

namespace {

/// Unit and dimensions of a dataset, as xarray and netCDF read them.
bool describe(const Handle& dataset, const std::string& units, const std::vector<const Handle*>& scales) {
    return dataset.ok() && set_attribute(dataset.id(), "units", units) &&
           hdf5::attach_scales(dataset, scales);
}

bool write_described(hid_t parent, const std::string& name, const std::vector<double>& values,
                     const std::string& units, const Handle& scale) {
    return describe(hdf5::write_vector(parent, name, values), units, {&scale});
}

/// The numbers `first`, `first` + 1, ... of a dimension.
Handle write_scale(hid_t parent, const std::string& name, std::size_t count, double first) {
    std::vector<double> numbers(count);
    std::iota(numbers.begin(), numbers.end(), first);
    Handle scale = hdf5::write_vector(parent, name, numbers);
    if (!scale.ok() || !set_attribute(scale.id(), "units", std::string("1")) ||
        !hdf5::make_scale(scale, name))
        return {};
    return scale;
}

/// The datasets of one string that grow with the rows, and its dimensions; closed before their group.
struct StringTables {
    Handle group;
    Handle contact_scale, mode_scale;
    std::size_t contacts = 0;
    bool metered = false;  ///< each step: the last three exist
    Handle gap, impulse, energy, dissipated, contact_work, player_work;
};

bool write_settings(hid_t file, const Scene& scene, double sound_s) {
    const SceneDescription& settings = scene.description;
    return set_attribute(file, "schema", std::string("jawari.recording/1")) &&
           set_attribute(file, "jawari_version", std::string(JAWARI_VERSION)) &&
           set_attribute(file, "scene", scene.file) && set_attribute(file, "scene_json", scene.text) &&
           set_attribute(file, "duration_s", scene.duration_s) && set_attribute(file, "sound_s", sound_s) &&
           set_attribute(file, "output_rate_hz", settings.output_rate_hz) &&
           set_attribute(file, "contact_rate_hz", settings.contact_rate_hz) &&
           set_attribute(file, "scheme", word(settings.scheme)) &&
           set_attribute(file, "theta", settings.theta) && set_attribute(file, "law", word(settings.law));
}

bool write_contacts(hid_t group, const StringDescription& string, const StringModel& model,
                    const Handle& contact) {
    std::vector<double> position, height, restitution, takes_part;
    std::vector<std::string> side;
    for (std::size_t c = 0; c < string.contacts.size(); ++c) {
        position.push_back(string.contacts[c].position_m);
        height.push_back(string.contacts[c].height_m);
        restitution.push_back(string.contacts[c].restitution);
        side.push_back(word(string.contacts[c].side));
        takes_part.push_back(model.shape->contact_of_description[c] >= 0 ? 1 : 0);
    }
    return write_described(group, "contact_position_m", position, "m", contact) &&
           write_described(group, "contact_height_m", height, "m", contact) &&
           write_described(group, "contact_restitution", restitution, "1", contact) &&
           hdf5::attach_scales(hdf5::write_strings(group, "contact_side", side), {&contact}) &&
           write_described(group, "contact_takes_part", takes_part, "1", contact);
}

std::vector<double> first_modes(const AlignedVector<double>& values, std::size_t count, double factor = 1) {
    std::vector<double> result(count);
    for (std::size_t k = 0; k < count; ++k) result[k] = factor * values[k];
    return result;
}

bool write_modes(hid_t group, const StringModel& model, const Handle& mode) {
    constexpr double per_turn = 1 / 6.283185307179586476925286766559;
    const std::size_t modes = model.shape->mode_count;
    return write_described(group, "frequency_hz", first_modes(model.tuning.omega, modes, per_turn), "Hz",
                           mode) &&
           write_described(group, "decay_per_s", first_modes(model.shape->sigma, modes), "1/s", mode);
}

bool create_tables(std::uint64_t rows, const Handle& time, StringTables& tables) {
    const hid_t group = tables.group.id();
    const Extent per_contact{rows, tables.contacts};
    const Extent per_row{rows, {}};
    // Impulses are zero nearly everywhere; gaps and energies hardly compress.
    tables.gap = hdf5::create_table(group, "gap_m", per_contact, false);
    tables.impulse = hdf5::create_table(group, "impulse_Ns", per_contact, true);
    tables.energy = hdf5::create_table(group, "energy_J", per_row, false);
    const Handle& contact = tables.contact_scale;
    const bool created = describe(tables.gap, "m", {&time, &contact}) &&
                         describe(tables.impulse, "N s", {&time, &contact}) &&
                         describe(tables.energy, "J", {&time});
    if (!tables.metered) return created;
    tables.dissipated = hdf5::create_table(group, "dissipated_J", per_row, false);
    tables.contact_work = hdf5::create_table(group, "contact_work_J", per_row, false);
    tables.player_work = hdf5::create_table(group, "player_work_J", per_row, false);
    return created && describe(tables.dissipated, "J", {&time}) &&
           describe(tables.contact_work, "J", {&time}) && describe(tables.player_work, "J", {&time});
}

bool create_string(hid_t parent, std::size_t index, const StringDescription& string, const StringModel& model,
                   std::uint64_t rows, const Handle& time, Metering metering, StringTables& tables) {
    tables.group = hdf5::create_group(parent, std::to_string(index));
    const hid_t group = tables.group.id();
    tables.contacts = string.contacts.size();
    tables.metered = metering == Metering::Step;
    tables.contact_scale = write_scale(group, "contact", tables.contacts, 0);
    tables.mode_scale = write_scale(group, "mode", model.shape->mode_count, 1);
    return tables.group.ok() && tables.contact_scale.ok() && tables.mode_scale.ok() &&
           create_tables(rows, time, tables) && set_attribute(group, "name", string.name) &&
           set_attribute(group, "length_m", string.length_m) &&
           set_attribute(group, "linear_density_kg_per_m", string.linear_density_kg_per_m) &&
           set_attribute(group, "start", word(string.initial.start)) &&
           set_attribute(group, "modes", std::uint64_t{model.shape->mode_count}) &&
           write_contacts(group, string, model, tables.contact_scale) &&
           write_modes(group, model, tables.mode_scale);
}

bool write_string_rows(const StringTables& tables, const StringRows& rows, std::uint64_t first,
                       std::uint64_t count) {
    const Extent per_contact{count, tables.contacts};
    const Extent per_row{count, {}};
    const bool written = hdf5::write_rows(tables.gap, first, per_contact, rows.gap_m.data()) &&
                         hdf5::write_rows(tables.impulse, first, per_contact, rows.impulse_Ns.data()) &&
                         hdf5::write_rows(tables.energy, first, per_row, rows.energy_J.data());
    if (!tables.metered) return written;
    return written && hdf5::write_rows(tables.dissipated, first, per_row, rows.dissipated_J.data()) &&
           hdf5::write_rows(tables.contact_work, first, per_row, rows.contact_work_J.data()) &&
           hdf5::write_rows(tables.player_work, first, per_row, rows.player_work_J.data());
}

bool write_counters(hid_t group, const StringStats& stats) {
    const Counters& counters = stats.counters;
    return set_attribute(group, "initial_energy_J", stats.initial_energy_J) &&
           set_attribute(group, "final_energy_J", stats.final_energy_J) &&
           set_attribute(group, "highest_energy_J", stats.highest_energy_J) &&
           set_attribute(group, "steps", counters.steps) &&
           set_attribute(group, "candidates", counters.candidates) &&
           set_attribute(group, "impulses", counters.impulses) &&
           set_attribute(group, "solves", counters.solves) &&
           set_attribute(group, "truncated_solves", counters.truncated_solves) &&
           set_attribute(group, "nonfinite_resets", counters.nonfinite_resets) &&
           set_attribute(group, "lcp_residual_max_m", counters.worst_residual_m) &&
           set_attribute(group, "worst_penetration_m", counters.worst_penetration_m);
}

/// The names are the dimension of the probes.
bool write_probe_labels(hid_t file, const std::vector<ProbeLabel>& probes, Handle& name_scale) {
    std::vector<std::string> names, units;
    for (const ProbeLabel& probe : probes) {
        names.push_back(probe.name);
        units.push_back(probe.unit);
    }
    name_scale = hdf5::write_strings(file, "probe_name", names);
    return name_scale.ok() && hdf5::make_scale(name_scale, "probe_name") &&
           hdf5::attach_scales(hdf5::write_strings(file, "probe_unit", units), {&name_scale});
}

}  // namespace

/// Members close in reverse order: datasets before groups before the file.
struct Hdf5Output::Tables {
    Handle file;
    Handle group;
    Handle time, probes, probe_name;
    std::size_t probe_count = 0;
    std::vector<StringTables> strings;
    std::vector<double> scratch;
    bool begun = false;
    std::uint64_t first_row = 0;  ///< of the recording, which a resumed one begins later

    bool create(const std::string& path, const Scene& scene, const SceneModel& model,
                const std::vector<ProbeLabel>& labels, std::uint64_t rows, Metering metering) {
        hdf5::quiet();
        file = hdf5::create_file(path);
        if (!file.ok() ||
            !write_settings(file.id(), scene, static_cast<double>(rows - 1) / model.output_rate_hz))
            return false;
        probe_count = labels.size();
        time = hdf5::create_table(file.id(), "time_s", {rows, {}}, false);
        probes = hdf5::create_table(file.id(), "probes", {rows, probe_count}, false);
        group = hdf5::create_group(file.id(), "strings");
        if (!time.ok() || !set_attribute(time.id(), "units", std::string("s")) ||
            !hdf5::make_scale(time, "time_s") || !probes.ok() || !group.ok() ||
            !write_probe_labels(file.id(), labels, probe_name) ||
            !hdf5::attach_scales(probes, {&time, &probe_name}))
            return false;
        strings.resize(model.strings.size());
        for (std::size_t s = 0; s < strings.size(); ++s)
            if (!create_string(group.id(), s, scene.description.strings[s], model.strings[s], rows, time,
                               metering, strings[s]))
                return false;
        return true;
    }

    bool close() {
        bool closed = true;
        for (StringTables& string : strings)
            for (Handle* handle :
                 {&string.gap, &string.impulse, &string.energy, &string.dissipated, &string.contact_work,
                  &string.player_work, &string.contact_scale, &string.mode_scale, &string.group})
                closed = handle->close() && closed;
        for (Handle* handle : {&time, &probes, &probe_name, &group}) closed = handle->close() && closed;
        const bool flushed = H5Fflush(file.id(), H5F_SCOPE_GLOBAL) >= 0;
        return file.close() && flushed && closed;
    }
};

Hdf5Output::Hdf5Output(OutputFile file, std::unique_ptr<Tables> tables)
    : file_(std::move(file)), tables_(std::move(tables)) {}
Hdf5Output::Hdf5Output(Hdf5Output&& other) noexcept = default;
Hdf5Output& Hdf5Output::operator=(Hdf5Output&& other) noexcept = default;
Hdf5Output::~Hdf5Output() = default;

Error Hdf5Output::failure() const {
    return errno != 0 ? file_error(file_.path(), errno) : file_error(file_.path(), "HDF5 cannot write it");
}

Outcome<Hdf5Output> Hdf5Output::create(OutputFile file, const Scene& scene, const SceneModel& model,
                                       const std::vector<ProbeLabel>& probes, std::uint64_t rows,
                                       Metering metering) {
    if (!file.seekable()) return file_error(file.path(), "not a regular file (allowed: a file, for HDF5)");
    Hdf5Output output(std::move(file), std::make_unique<Tables>());
    output.output_rate_hz_ = model.output_rate_hz;
    errno = 0;
    if (!output.tables_->create(output.file_.temporary_path(), scene, model, probes, rows, metering))
        return output.failure();
    return output;
}

MaybeError Hdf5Output::write(const RowBlock& block) {
    errno = 0;
    if (!tables_->begun) tables_->first_row = block.first;
    tables_->begun = true;
    const std::uint64_t row = block.first - tables_->first_row;
    auto& scratch = tables_->scratch;
    scratch.clear();
    for (std::size_t i = 0; i < block.count; ++i)
        scratch.push_back(static_cast<double>(block.first + i) / output_rate_hz_);
    if (!hdf5::write_rows(tables_->time, row, {block.count, {}}, scratch.data())) return failure();
    scratch.clear();
    for (std::size_t i = 0; i < block.count; ++i)
        for (const auto& probe : block.probes) scratch.push_back(probe[i]);
    if (!hdf5::write_rows(tables_->probes, row, {block.count, tables_->probe_count}, scratch.data()))
        return failure();
    for (std::size_t s = 0; s < block.strings.size(); ++s)
        if (!write_string_rows(tables_->strings[s], block.strings[s], row, block.count)) return failure();
    return std::nullopt;
}

MaybeError Hdf5Output::write_final(const SceneModel& model, const SceneState& state,
                                   const SimulationStats& stats) {
    errno = 0;
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        const hid_t group = tables_->strings[s].group.id();
        const Handle& mode = tables_->strings[s].mode_scale;
        const std::size_t modes = model.strings[s].shape->mode_count;
        const bool written =
            write_described(group, "final_modal_displacement",
                            first_modes(state.strings[s].displacement, modes), "m^(3/2)", mode) &&
            write_described(group, "final_modal_velocity", first_modes(state.strings[s].velocity, modes),
                            "m^(3/2)/s", mode) &&
            write_counters(group, stats.strings[s]);
        if (!written) return failure();
    }
    return std::nullopt;
}

MaybeError Hdf5Output::commit() {
    errno = 0;
    if (!tables_->close()) return failure();
    return file_.commit();
}

}  // namespace jawari::host
