#include "formats/scene/read_drives.h"

namespace jawari::host {

namespace {

using json::ObjectReader;

/// A pluck pulls the string slowly enough not to shake it.
constexpr double default_rise_s = 0.005;
constexpr json::Range times{0, longest_duration_s};

void read_force(ObjectReader& reader, System& system, StringDescription& string, DrivenTables& tables) {
    const Place place = system.place(reader);
    string.forces.push_back({place.position_m, place.point, {}});
    tables.forces.push_back({read_time_table(reader, "force_N", "scale_N"), {}});
}

/// A force that rises from nothing and lets go. `height_m` waits for the mode shapes, which a bar has only
/// once all places are read.
void read_pluck(ObjectReader& reader, System& system, StringDescription& string, DrivenTables& tables) {
    const Place place = system.place(reader);
    const double time_s = reader.number("time_s", times);
    const double rise_s = reader.number_or("rise_s", std::min(default_rise_s, time_s), times);
    if (rise_s > time_s)
        reader.problems().add(reader.path_of("rise_s"), json::describe(json::Value{rise_s}),
                              "at most time_s");
    ForceTable force;
    force.table.place = reader.path();
    force.table.time_s = {time_s - rise_s, time_s, time_s};
    if (reader.has("height_m") == reader.has("force_N")) {
        reader.problems().add(reader.path(), reader.has("force_N") ? "both" : "neither",
                              "one of height_m and force_N");
    } else if (reader.has("height_m")) {
        force.height_m = reader.number("height_m");
        force.table.value = {0, 1, 0};
    } else {
        force.table.value = {0, reader.number("force_N"), 0};
    }
    string.forces.push_back({place.position_m, place.point, {}});
    tables.forces.push_back(std::move(force));
}

template <class Read>
void read_each(ObjectReader& reader, std::string_view key, const std::vector<std::string_view>& keys,
               const Read& read) {
    if (!reader.has(key)) return;
    const json::Array* array = reader.array(key, limits::forces);
    if (array == nullptr) return;
    for (std::size_t i = 0; i < array->size() && !reader.problems().any(); ++i) {
        ObjectReader item((*array)[i], json::indexed(reader.path_of(key), i), keys, reader.problems());
        read(item);
    }
}

}  // namespace

void read_forces(ObjectReader& reader, System& system, StringDescription& string, DrivenTables& tables) {
    std::vector<std::string_view> keys = table_keys("force_N", "scale_N");
    keys.push_back(system.place_key());
    read_each(reader, "forces", keys, [&](ObjectReader& item) { read_force(item, system, string, tables); });
}

void read_plucks(ObjectReader& reader, System& system, StringDescription& string, DrivenTables& tables) {
    read_each(reader, "plucks", {system.place_key(), "time_s", "rise_s", "height_m", "force_N"},
              [&](ObjectReader& item) { read_pluck(item, system, string, tables); });
}

void read_motion(ObjectReader& contact, std::size_t index, DrivenTables& tables) {
    const json::Value* value = contact.find("motion");
    if (value == nullptr) return;
    ObjectReader reader(*value, contact.path_of("motion"), table_keys("height_m", "scale_m"),
                        contact.problems());
    tables.motions.push_back({read_time_table(reader, "height_m", "scale_m"), index});
}

}  // namespace jawari::host
