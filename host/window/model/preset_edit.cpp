#include "window/model/preset_edit.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <variant>

namespace jawari::host::window {

namespace {

using Json = nlohmann::ordered_json;

constexpr double deepest_fret_m = -0.02;
constexpr double highest_fret_m = -0.00005;
/// Of the speaking length, at both of its ends.
constexpr double end_share = 0.01;
constexpr double longest_profile_m = 0.5;
constexpr double deepest_drop_m = 0.02;

double rounded(double metres) {
    constexpr double step_m = 1e-6;
    return std::round(metres / step_m) * step_m;
}

const FretsDescription& frets_on(const InstrumentDescription& instrument, std::size_t string) {
    const auto& own = instrument.strings[string].frets;
    return own ? *own : instrument.frets;
}

double place_on(const StringPlace& place, double length_m) {
    return place.share > 0 ? place.share * length_m : place.from_bridge_m;
}

bool lies_under(const ObstacleDescription& obstacle, std::size_t string) {
    return obstacle.strings.empty() ||
           std::find(obstacle.strings.begin(), obstacle.strings.end(), string) != obstacle.strings.end();
}

/// Distance from the bridge of a point of an obstacle's profile under the open string.
double from_bridge_of(Origin origin, double distance_m, double length_m) {
    return origin == Origin::Bridge ? distance_m : length_m - distance_m;
}

void add_frets(std::vector<Handle>& handles, const FretsDescription& frets,
               const std::vector<double>& from_bridge_m, double length_m) {
    const std::size_t count = std::min(frets.height_m.size(), from_bridge_m.size());
    if (count == 0) return;
    for (std::size_t f = 1; f <= count; ++f)
        handles.push_back({{Part::Fret, f, 0},
                           from_bridge_m[f - 1],
                           frets.height_m[f - 1],
                           false,
                           true,
                           "fret " + std::to_string(f)});
    handles.push_back({{Part::Action, 0, 0}, from_bridge_m[count - 1] * 0.5, 0, false, true, "action"});
    handles.push_back(
        {{Part::Relief, 0, 0}, (length_m + from_bridge_m[count - 1]) / 2, 0, false, true, "relief"});
}

void add_obstacle(std::vector<Handle>& handles, const ObstacleDescription& obstacle, std::size_t index,
                  double length_m) {
    const std::string name = obstacle.name.empty() ? "obstacle" : obstacle.name;
    if (const auto* parabola = std::get_if<ParabolicProfile>(&obstacle.profile)) {
        handles.push_back({{Part::ObstacleEnd, index, 0},
                           from_bridge_of(obstacle.origin, parabola->length_m, length_m),
                           parabola->height_m - parabola->drop_m,
                           true,
                           true,
                           name});
        return;
    }
    const auto& corners = std::get<CornerProfile>(obstacle.profile);
    constexpr std::size_t most_handles = 16;  // more would lie on one another
    if (corners.size() > most_handles) return;
    for (std::size_t c = 0; c < corners.size(); ++c)
        handles.push_back({{Part::ObstacleCorner, index, c},
                           from_bridge_of(obstacle.origin, corners[c].first, length_m),
                           corners[c].second,
                           false,
                           true,
                           name});
}

/// What every stop of a string has: places beyond it are refused. From the bridge.
double shortest_m(double length_m, const std::vector<double>& fret_from_bridge_m) {
    double shortest = length_m;
    for (const double place_m : fret_from_bridge_m) shortest = std::min(shortest, place_m);
    return shortest;
}

/// A place that is given as a share of the length stays one.
bool set_place(Json& object, double from_bridge_m, double length_m, double shortest) {
    if (!object.is_object()) return false;
    const double place = rounded(std::clamp(from_bridge_m, end_share * length_m, (1 - end_share) * shortest));
    if (object.contains("position_share"))
        object["position_share"] = place / length_m;
    else
        object["position_from_bridge_m"] = place;
    return true;
}

Json* entry(Json& preset, const char* list, std::size_t index) {
    if (!preset.contains(list) || !preset[list].is_array() || index >= preset[list].size()) return nullptr;
    return &preset[list][index];
}

/// The section that has the frets of the string.
Json* frets_section(Json& preset, std::size_t string) {
    Json* const own = entry(preset, "strings", string);
    Json* const holder = own != nullptr && own->contains("frets") ? own : &preset;
    if (!holder->contains("frets") || !(*holder)["frets"].contains("height_m")) return nullptr;
    return &(*holder)["frets"];
}

/// Adds lift(t) to the height of each fret, t: 0 at the nut, 1 at the last fret.
template <class Lift>
bool lift_frets(Json& preset, std::size_t string, double length_m, const std::vector<double>& from_bridge_m,
                Lift lift) {
    Json* const frets = frets_section(preset, string);
    if (frets == nullptr || from_bridge_m.empty()) return false;
    Json& heights = (*frets)["height_m"];
    const double neck_m = length_m - from_bridge_m[std::min(heights.size(), from_bridge_m.size()) - 1];
    for (std::size_t f = 0; f < std::min(heights.size(), from_bridge_m.size()); ++f) {
        const double t = (length_m - from_bridge_m[f]) / neck_m;
        heights[f] = rounded(std::clamp(heights[f].get<double>() + lift(t), deepest_fret_m, highest_fret_m));
    }
    return true;
}

bool move_exciter(Json& preset, std::size_t index, std::size_t string, double length_m, double shortest,
                  const Move& move) {
    Json* const own = entry(preset, "strings", string);
    if (own != nullptr && own->contains("exciter_place"))
        return set_place((*own)["exciter_place"], move.from_bridge_m, length_m, shortest);
    Json* const exciter = entry(preset, "exciters", index);
    return exciter != nullptr && set_place(*exciter, move.from_bridge_m, length_m, shortest);
}

bool move_fret(Json& preset, std::size_t fret, std::size_t string, const Move& move) {
    Json* const frets = frets_section(preset, string);
    if (frets == nullptr || fret < 1 || fret > (*frets)["height_m"].size()) return false;
    (*frets)["height_m"][fret - 1] = rounded(std::clamp(move.height_m, deepest_fret_m, highest_fret_m));
    return true;
}

bool move_obstacle(Json& preset, const InstrumentDescription& instrument, const PartName& name,
                   double length_m, const Move& move) {
    Json* const obstacle = entry(preset, "obstacles", name.index);
    if (obstacle == nullptr || name.index >= instrument.obstacles.size()) return false;
    const Origin origin = instrument.obstacles[name.index].origin;
    if (name.part == Part::ObstacleEnd) {
        if (!obstacle->contains("parabola")) return false;
        Json& parabola = (*obstacle)["parabola"];
        const double extent_m = from_bridge_of(origin, move.from_bridge_m, length_m);
        const double top_m = parabola.value("height_m", 0.0);
        parabola["length_m"] = rounded(std::clamp(extent_m, 0.001, std::min(longest_profile_m, length_m)));
        parabola["drop_m"] = rounded(std::clamp(top_m - move.height_m, 0.0, deepest_drop_m));
        return true;
    }
    if (!obstacle->contains("profile_m") || name.corner >= (*obstacle)["profile_m"].size()) return false;
    (*obstacle)["profile_m"][name.corner][1] = rounded(std::clamp(move.height_m, -0.1, 0.1));
    return true;
}

}  // namespace

std::vector<Handle> handles_of(const InstrumentDescription& instrument, std::size_t string, double length_m,
                               const std::vector<double>& fret_from_bridge_m) {
    std::vector<Handle> handles;
    const auto& own_place = instrument.strings[string].exciter_place;
    for (std::size_t e = 0; e < instrument.exciters.size(); ++e) {
        const ExciterDescription& exciter = instrument.exciters[e];
        const bool plays = string >= exciter.first_string && string <= exciter.last_string;
        if (!plays || std::holds_alternative<TangentDescription>(exciter.body)) continue;
        handles.push_back({{Part::Exciter, e, 0},
                           place_on(own_place.value_or(exciter.place), length_m),
                           0,
                           true,
                           false,
                           exciter.name.empty() ? "pluck" : exciter.name});
        if (own_place) break;  // all exciters are there
    }
    for (std::size_t p = 0; p < instrument.pickups.size(); ++p) {
        if (instrument.pickups[p].quantity == PickupQuantity::BridgeForce) continue;
        handles.push_back({{Part::Pickup, p, 0},
                           place_on(instrument.pickups[p].place, length_m),
                           0,
                           true,
                           false,
                           instrument.pickups.size() == 1 ? "pickup" : "pickup " + std::to_string(p + 1)});
    }
    add_frets(handles, frets_on(instrument, string), fret_from_bridge_m, length_m);
    for (std::size_t o = 0; o < instrument.obstacles.size(); ++o)
        if (lies_under(instrument.obstacles[o], string))
            add_obstacle(handles, instrument.obstacles[o], o, length_m);
    return handles;
}

std::optional<std::string> with_part_moved(const std::string& text, const InstrumentDescription& instrument,
                                           std::size_t string, double length_m,
                                           const std::vector<double>& fret_from_bridge_m,
                                           const PartName& name, const Move& move) {
    Json preset = Json::parse(text, nullptr, false);
    if (!preset.is_object() || string >= instrument.strings.size()) return std::nullopt;
    const double shortest = shortest_m(length_m, fret_from_bridge_m);
    bool moved = false;
    switch (name.part) {
        case Part::Exciter:
            moved = move_exciter(preset, name.index, string, length_m, shortest, move);
            break;
        case Part::Pickup: {
            Json* const pickup = entry(preset, "pickups", name.index);
            moved = pickup != nullptr && set_place(*pickup, move.from_bridge_m, length_m, shortest);
            break;
        }
        case Part::Fret:
            moved = move_fret(preset, name.index, string, move);
            break;
        case Part::Action:
            // The bridge is raised: frets sink as their distance from the nut.
            moved = lift_frets(preset, string, length_m, fret_from_bridge_m,
                               [&](double t) { return -move.height_m * t; });
            break;
        case Part::Relief:
            moved = lift_frets(preset, string, length_m, fret_from_bridge_m,
                               [&](double t) { return move.height_m * 4 * t * (1 - t); });
            break;
        case Part::ObstacleEnd:
        case Part::ObstacleCorner:
            moved = move_obstacle(preset, instrument, name, length_m, move);
            break;
    }
    if (!moved) return std::nullopt;
    return preset.dump();
}

}  // namespace jawari::host::window
