#include "formats/preset/read_obstacles.h"

#include "formats/preset/read_section.h"

namespace jawari::host::preset {

namespace {

using json::Problems;
using json::Value;

CornerProfile read_corners(Section& reader) {
    CornerProfile corners;
    const json::Array* array = reader.array("profile_m", limits::obstacle_points);
    if (array == nullptr) return corners;
    for (std::size_t i = 0; i < array->size() && !reader.problems().any(); ++i) {
        const std::string place = json::indexed(reader.path_of("profile_m"), i);
        const std::vector<double> corner = json::read_numbers((*array)[i], place, 2, reader.problems());
        if (corner.size() == 2) {
            corners.emplace_back(corner[0], corner[1]);
        } else {
            reader.problems().add(place, std::to_string(corner.size()) + " numbers",
                                  "two numbers: distance and height");
        }
    }
    return corners;
}

ParabolicProfile read_parabola(const Value& value, const std::string& path, Problems& problems) {
    Section reader(value, path, {"length_m", "drop_m", "height_m"}, problems);
    ParabolicProfile parabola;
    parabola.length_m = reader.number("length_m");
    parabola.drop_m = reader.number("drop_m");
    parabola.height_m = reader.number_or("height_m", parabola.height_m);
    return parabola;
}

}  // namespace

ObstacleDescription read_obstacle(const Value& value, const std::string& path, Problems& problems) {
    Section reader(value, path,
                   {"name", "origin", "side", "profile_m", "parabola", "points", "restitution", "strings"},
                   problems);
    ObstacleDescription obstacle;
    obstacle.name = reader.text("name");
    obstacle.origin = reader.choice<Origin>(
        "origin", {{"bridge", Origin::Bridge}, {"nut", Origin::Nut}, {"stop", Origin::Stop}});
    obstacle.side =
        reader.choice_or<Side>("side", obstacle.side, {{"below", Side::Below}, {"above", Side::Above}});
    if (reader.has("points")) obstacle.points = reader.whole_number("points", 0, limits::obstacle_points);
    obstacle.restitution = reader.number_or("restitution", obstacle.restitution);
    obstacle.strings = reader.indices_or_empty("strings", limits::instrument_strings);
    if (reader.has("profile_m") == reader.has("parabola")) {
        problems.add(reader.path_of("profile_m"),
                     reader.has("parabola") ? "given beside parabola" : "missing",
                     "either profile_m or parabola");
    } else if (const Value* parabola = reader.find("parabola")) {
        obstacle.profile = read_parabola(*parabola, reader.path_of("parabola"), problems);
    } else {
        obstacle.profile = read_corners(reader);
    }
    return obstacle;
}

SoftTouchDescription read_soft_touch(const Value& value, const std::string& path, Problems& problems) {
    Section reader(value, path,
                   {"name", "position_from_bridge_m", "position_share", "width_m", "damping_kg_per_s",
                    "stiffness_N_per_m", "strings"},
                   problems);
    SoftTouchDescription touch;
    touch.name = reader.text("name");
    touch.place = reader.place();
    touch.width_m = reader.number_or("width_m", touch.width_m);
    touch.damping_kg_per_s = reader.number("damping_kg_per_s");
    touch.stiffness_N_per_m = reader.number_or("stiffness_N_per_m", touch.stiffness_N_per_m);
    touch.strings = reader.indices_or_empty("strings", limits::instrument_strings);
    return touch;
}

}  // namespace jawari::host::preset
