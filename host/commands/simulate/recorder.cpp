#include "commands/simulate/recorder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "formats/scene/words.h"
#include "jawari/scene/modes.h"

namespace jawari::host {

namespace {

constexpr std::size_t grid_intervals = 400;
constexpr std::size_t snapshots = 9;
/// Bounds the memory that contact events can take.
constexpr std::uint64_t most_events = 4'000'000;

std::uint64_t divide_up(std::uint64_t a, std::uint64_t b) {
    return (a + b - 1) / b;
}

/// Of the lowest mode that swings.
double lowest_omega(const StringModel& string) {
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < string.shape->mode_count; ++k) {
        if (string.tuning.omega[k] > 0) lowest = std::min(lowest, string.tuning.omega[k]);
    }
    return lowest;
}

std::vector<std::uint64_t> choose_snapshot_rows(const StringModel& string, double output_rate_hz,
                                                std::uint64_t last_row) {
    const double period_rows = 6.283185307179586 / lowest_omega(string) * output_rate_hz;
    const double span = std::min(period_rows, static_cast<double>(last_row));
    std::vector<std::uint64_t> rows;
    for (std::size_t i = 0; i < snapshots; ++i)
        rows.push_back(
            static_cast<std::uint64_t>(std::llround(span * static_cast<double>(i) / (snapshots - 1))));
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
}

std::vector<double> grid_of(double length_m) {
    std::vector<double> grid;
    for (std::size_t i = 0; i <= grid_intervals; ++i)
        grid.push_back(length_m * static_cast<double>(i) / static_cast<double>(grid_intervals));
    return grid;
}

std::vector<double> shape_of(const StringModel& string, const StringState& state,
                             const std::vector<double>& grid) {
    std::vector<double> shape;
    for (const double x : grid) {
        double sum = 0;
        const std::size_t modes = string.shape->mode_count - string.shape->hammer_count;
        for (std::size_t k = 0; k < modes; ++k)
            sum += mode_shape(k + 1, x, string.shape->length_m) * state.displacement[k];
        shape.push_back(sum);
    }
    return shape;
}

/// Where the picture puts a contact of a system that is no string: the place along a bar, else its number.
double place_of(const StringDescription& string, std::size_t contact) {
    const ContactDescription& description = string.contacts[contact];
    const std::vector<std::string>& names = string.shapes->names;
    if (description.point >= names.size()) return static_cast<double>(contact);
    return parse_number(names[description.point]).value_or(static_cast<double>(contact));
}

StringRecording empty_recording(const StringDescription& string) {
    StringRecording recording;
    recording.name = string.name;
    recording.is_string = !string.shapes;
    if (recording.is_string) {
        recording.length_m = string.length_m;
        recording.grid_m = grid_of(string.length_m);
    }
    for (std::size_t c = 0; c < string.contacts.size(); ++c) {
        const ContactDescription& contact = string.contacts[c];
        const double place = recording.is_string ? contact.position_m : place_of(string, c);
        recording.obstacles.push_back({place, contact.height_m, contact.side});
        recording.length_m = std::max(recording.length_m, place);
    }
    if (recording.length_m == 0) recording.length_m = 1;  // an axis has a length
    return recording;
}

std::size_t most_contacts(const SceneDescription& scene) {
    std::size_t most = 1;
    for (const StringDescription& string : scene.strings) most = std::max(most, string.contacts.size());
    return most;
}

}  // namespace

Recorder::Recorder(const Scene& scene, const SceneModel& model, const std::vector<ProbeLabel>& probes,
                   std::uint64_t last_row)
    : model_(model), last_row_(last_row) {
    const std::uint64_t rows = last_row + 1;
    rows_per_bucket_ = rows <= recording_rows ? 1 : divide_up(2 * rows, recording_rows);
    rows_per_event_ =
        std::max(rows_per_bucket_, divide_up(rows * most_contacts(scene.description), most_events));
    recording_.title = scene.name;
    recording_.duration_s = static_cast<double>(last_row) / model.output_rate_hz;
    recording_.interval_s = static_cast<double>(rows_per_event_) / model.output_rate_hz;
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        recording_.strings.push_back(empty_recording(scene.description.strings[s]));
        snapshot_rows_.emplace_back();
        if (recording_.strings.back().is_string)
            snapshot_rows_.back() = choose_snapshot_rows(model.strings[s], model.output_rate_hz, last_row);
        impulses_.emplace_back(scene.description.strings[s].contacts.size(), 0.0);
    }
    for (const ProbeLabel& probe : probes)
        recording_.strings[probe.string].probes.push_back({probe.name, probe.unit, probe.quantity, {}});
    lowest_.assign(probes.size(), std::numeric_limits<double>::infinity());
    highest_.assign(probes.size(), -std::numeric_limits<double>::infinity());
}

void Recorder::observe(std::uint64_t row, const SceneState& state) {
    for (std::size_t s = 0; s < model_.strings.size(); ++s) {
        const auto& rows = snapshot_rows_[s];
        if (!std::binary_search(rows.begin(), rows.end(), row)) continue;
        StringRecording& recording = recording_.strings[s];
        recording.snapshots.push_back({static_cast<double>(row) / model_.output_rate_hz,
                                       shape_of(model_.strings[s], state.strings[s], recording.grid_m)});
    }
}

void Recorder::add(const RowBlock& block) {
    add_probes(block);
    for (std::size_t s = 0; s < block.strings.size(); ++s) add_events(block, s);
}

void Recorder::add_probes(const RowBlock& block) {
    if (recording_.times_s.empty()) bucket_first_ = std::max(bucket_first_, block.first);
    std::vector<std::vector<double>*> values;
    for (StringRecording& string : recording_.strings)
        for (ProbeSignal& probe : string.probes) values.push_back(&probe.values);
    for (std::size_t i = 0; i < block.count; ++i) {
        const std::uint64_t row = block.first + i;
        for (std::size_t p = 0; p < values.size(); ++p) {
            lowest_[p] = std::min(lowest_[p], block.probes[p][i]);
            highest_[p] = std::max(highest_[p], block.probes[p][i]);
        }
        const bool bucket_full = row + 1 - bucket_first_ == rows_per_bucket_;
        if (!bucket_full && row != last_row_) continue;
        recording_.times_s.push_back(static_cast<double>(bucket_first_) / model_.output_rate_hz);
        if (rows_per_bucket_ > 1)
            recording_.times_s.push_back(static_cast<double>(row) / model_.output_rate_hz);
        for (std::size_t p = 0; p < values.size(); ++p) {
            values[p]->push_back(lowest_[p]);
            if (rows_per_bucket_ > 1) values[p]->push_back(highest_[p]);
            lowest_[p] = std::numeric_limits<double>::infinity();
            highest_[p] = -std::numeric_limits<double>::infinity();
        }
        bucket_first_ = row + 1;
    }
}

void Recorder::add_events(const RowBlock& block, std::size_t string) {
    std::vector<double>& sums = impulses_[string];
    for (std::size_t i = 0; i < block.count; ++i) {
        const std::uint64_t row = block.first + i;
        for (std::size_t c = 0; c < sums.size(); ++c)
            sums[c] += block.strings[string].impulse_Ns[i * sums.size() + c];
        if (row % rows_per_event_ != 0 && row != last_row_) continue;
        const double time_s = static_cast<double>(row) / model_.output_rate_hz;
        for (std::size_t c = 0; c < sums.size(); ++c) {
            if (sums[c] > 0) recording_.strings[string].events.push_back({time_s, c, sums[c]});
            sums[c] = 0;
        }
    }
}

}  // namespace jawari::host
