#include "formats/scene/system.h"

#include <algorithm>

#include "base/text.h"
#include "formats/scene/read_modes.h"

namespace jawari::host {

namespace {

using json::ObjectReader;
using json::Problems;
using json::Value;

/// What physical quantities may be: more than nothing, less than overflows.
constexpr json::Range physical{1e-15, 1e15};
constexpr json::Range lengths{0.001, 1000};

bool has_key(const Value& value, std::string_view key) {
    const auto* object = std::get_if<json::Object>(&value.content);
    return object != nullptr && json::find(*object, key) != nullptr;
}

/// Losses that a bar or a plate may have.
SystemLoss read_loss(ObjectReader& reader) {
    const Value* value = reader.find("damping");
    if (value == nullptr) return NoLoss{};
    const Damping damping = read_damping(*value, reader.path_of("damping"), reader.problems());
    if (const auto* decay = std::get_if<DecayTimePoints>(&damping)) return *decay;
    if (std::holds_alternative<ValetteLoss>(damping))
        reader.problems().add(reader.path_of("damping"), "the model valette", "\"none\", \"t60\"");
    return NoLoss{};
}

BarEnd read_end(const Value& value, const std::string& path, Problems& problems) {
    const auto* word = std::get_if<std::string>(&value.content);
    if (word != nullptr && *word == "pinned") return BarEnd::Pinned;
    if (word != nullptr && *word == "clamped") return BarEnd::Clamped;
    if (word == nullptr || *word != "free")
        problems.add(path, json::describe(value), "\"free\", \"pinned\", \"clamped\"");
    return BarEnd::Free;
}

Bar read_bar(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(
        value, path,
        {"length_m", "linear_density_kg_per_m", "bending_stiffness_N_m2", "ends", "count", "damping"},
        problems);
    Bar bar;
    bar.length_m = reader.number("length_m", lengths);
    bar.linear_density_kg_per_m = reader.number("linear_density_kg_per_m", physical);
    bar.bending_stiffness_N_m2 = reader.number("bending_stiffness_N_m2", physical);
    if (const json::Array* ends = reader.array("ends", 2)) {
        if (ends->size() != 2) {
            problems.add(reader.path_of("ends"), json::describe(*reader.find("ends")), "an array of 2");
        } else {
            for (std::size_t i = 0; i < 2; ++i)
                bar.ends[i] = read_end((*ends)[i], json::indexed(reader.path_of("ends"), i), problems);
        }
    }
    bar.count = reader.whole_number("count", 1, limits::modes);
    bar.damping = read_loss(reader);
    return bar;
}

Plate read_plate(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path,
                        {"size_m", "thickness_m", "density_kg_per_m3", "youngs_modulus_Pa", "poissons_ratio",
                         "count", "damping"},
                        problems);
    Plate plate;
    const std::vector<double> size = reader.numbers("size_m", 2);
    for (std::size_t i = 0; i < 2; ++i) {
        const bool right = size.size() == 2 && size[i] >= lengths.lowest && size[i] <= lengths.highest;
        if (right) {
            plate.size_m[i] = size[i];
        } else if (const Value* given = reader.find("size_m")) {
            problems.add(reader.path_of("size_m"), json::describe(*given), "two lengths of 0.001 to 1000");
        }
    }
    plate.thickness_m = reader.number("thickness_m", physical);
    plate.density_kg_per_m3 = reader.number("density_kg_per_m3", physical);
    plate.youngs_modulus_Pa = reader.number("youngs_modulus_Pa", physical);
    plate.poissons_ratio = reader.number("poissons_ratio", {-0.999, 0.5});
    plate.count = reader.whole_number("count", 1, limits::modes);
    plate.damping = read_loss(reader);
    return plate;
}

ShapeTable read_shapes(ObjectReader& reader) {
    ShapeTable table;
    table.modal_mass_kg = reader.numbers("modal_mass_kg", limits::modes);
    const json::Array* points = reader.array("points", limits::shape_points);
    for (std::size_t p = 0; points != nullptr && p < points->size() && !reader.problems().any(); ++p) {
        table.points.push_back(json::read_numbers((*points)[p], json::indexed(reader.path_of("points"), p),
                                                  limits::modes, reader.problems()));
    }
    return table;
}

double read_coordinate(const Value& value, const std::string& path, double length_m, Problems& problems) {
    return json::read_number(value, path, json::Range{0, length_m}, problems);
}

}  // namespace

System System::read(const Value& modes, const std::string& path, Problems& problems) {
    System system;
    if (has_key(modes, "bar")) {
        ObjectReader reader(modes, path, {"bar"}, problems);
        system.kind_ = read_bar(*reader.find("bar"), reader.path_of("bar"), problems);
    } else if (has_key(modes, "plate")) {
        ObjectReader reader(modes, path, {"plate"}, problems);
        system.kind_ = read_plate(*reader.find("plate"), reader.path_of("plate"), problems);
    } else if (has_key(modes, "points") || has_key(modes, "modal_mass_kg")) {
        ObjectReader reader(modes, path, {"frequency_hz", "decay_per_s", "modal_mass_kg", "points"},
                            problems);
        system.modes_ = ModeTable{reader.numbers("frequency_hz", limits::modes),
                                  reader.numbers("decay_per_s", limits::modes)};
        system.kind_ = read_shapes(reader);
    } else {
        system.modes_ = read_modes(modes, path, problems);
    }
    return system;
}

std::string_view System::place_key() const {
    return std::holds_alternative<ShapeTable>(kind_) ? "point" : "position_m";
}

Place System::place(ObjectReader& reader) {
    Place place;
    Problems& problems = reader.problems();
    if (is_string()) {
        place.position_m = reader.number("position_m");
    } else if (const auto* bar = std::get_if<Bar>(&kind_)) {
        place.position_m = reader.number("position_m", {0, bar->length_m});
        place.point = bar_places_m_.size();
        bar_places_m_.push_back(place.position_m);
    } else if (const auto* plate = std::get_if<Plate>(&kind_)) {
        const std::string path = reader.path_of("position_m");
        place.point = plate_places_m_.size();
        plate_places_m_.push_back({});
        const Value* value = reader.require("position_m", "[x, y]");
        const auto* array = value == nullptr ? nullptr : std::get_if<json::Array>(&value->content);
        if (value != nullptr && (array == nullptr || array->size() != 2)) {
            problems.add(path, json::describe(*value), "[x, y]");
        } else if (array != nullptr) {
            for (std::size_t i = 0; i < 2; ++i)
                plate_places_m_.back()[i] =
                    read_coordinate((*array)[i], json::indexed(path, i), plate->size_m[i], problems);
        }
    } else {
        place.point = reader.whole_number("point", 0, limits::shape_points - 1);
    }
    return place;
}

void System::finish(StringDescription& string) const {
    string.modes = modes_;
    if (const auto* bar = std::get_if<Bar>(&kind_)) {
        // A system that nothing touches or reads has a point all the same.
        const std::vector<double> places = bar_places_m_.empty() ? std::vector<double>{0} : bar_places_m_;
        string.modes = bar_modes(*bar);
        string.shapes = bar_shapes(*bar, places);
        for (const double x : places) string.shapes->names.push_back(shortest(x));
    } else if (const auto* plate = std::get_if<Plate>(&kind_)) {
        const std::vector<std::array<double, 2>> places =
            plate_places_m_.empty() ? std::vector<std::array<double, 2>>{{}} : plate_places_m_;
        string.modes = plate_modes(*plate);
        string.shapes = plate_shapes(*plate, places);
        for (const auto& [x, y] : places)
            string.shapes->names.push_back("(" + shortest(x) + ";" + shortest(y) + ")");
    } else if (const auto* table = std::get_if<ShapeTable>(&kind_)) {
        string.shapes = *table;
    }
}

}  // namespace jawari::host
