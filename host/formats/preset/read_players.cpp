#include "formats/preset/read_players.h"

#include "formats/preset/read_section.h"

namespace jawari::host::preset {

namespace {

using json::Problems;
using json::Value;

enum class Kind { Finger, Hammer, Tangent };

FingerDescription finger(Section& reader) {
    FingerDescription body;
    body.rise_s = reader.number_or("rise_s", body.rise_s);
    body.release_s = reader.number_or("release_s", body.release_s);
    body.full_height_m = reader.number("full_height_m");
    body.height_exponent = reader.number_or("height_exponent", body.height_exponent);
    body.damping_kg_per_s = reader.number_or("damping_kg_per_s", body.damping_kg_per_s);
    body.roughness = reader.number_or("roughness", body.roughness);
    return body;
}

HammerDescription hammer(Section& reader) {
    HammerDescription body;
    body.mass_kg = reader.number("mass_kg");
    body.stiffness = reader.number("stiffness_N_per_m_p");
    body.exponent = reader.number_or("exponent", body.exponent);
    body.loss_s_per_m = reader.number_or("loss_s_per_m", body.loss_s_per_m);
    body.full_speed_m_per_s = reader.number("full_speed_m_per_s");
    body.speed_exponent = reader.number_or("speed_exponent", body.speed_exponent);
    body.side = reader.choice_or<Side>("side", body.side, {{"below", Side::Below}, {"above", Side::Above}});
    return body;
}

TangentDescription tangent(Section& reader) {
    TangentDescription body;
    body.rise_s = reader.number_or("rise_s", body.rise_s);
    body.full_height_m = reader.number("full_height_m");
    body.height_exponent = reader.number_or("height_exponent", body.height_exponent);
    return body;
}

Kind kind_of(const Value& value, const std::string& path, Problems& problems) {
    const auto* object = std::get_if<json::Object>(&value.content);
    const Value* kind = object == nullptr ? nullptr : json::find(*object, "kind");
    const auto* word = kind == nullptr ? nullptr : std::get_if<std::string>(&kind->content);
    if (word != nullptr && *word == "hammer") return Kind::Hammer;
    if (word != nullptr && *word == "tangent") return Kind::Tangent;
    if (word == nullptr || *word != "finger") {
        const std::string hint = word == nullptr ? "" : did_you_mean(*word, {"finger", "hammer", "tangent"});
        problems.add(json::member(path, "kind"), kind == nullptr ? "missing" : json::describe(*kind) + hint,
                     R"("finger", "hammer", "tangent")");
    }
    return Kind::Finger;
}

/// The keys that a kind has beside those of every exciter.
Section section_of(Kind kind, const Value& value, const std::string& path, Problems& problems) {
    switch (kind) {
        case Kind::Hammer:
            return {value,
                    path,
                    {"name", "kind", "position_from_bridge_m", "position_share", "width_m", "velocity_range",
                     "string_range", "mass_kg", "stiffness_N_per_m_p", "exponent", "loss_s_per_m",
                     "full_speed_m_per_s", "speed_exponent", "side"},
                    problems};
        case Kind::Tangent:
            return {value,
                    path,
                    {"name", "kind", "velocity_range", "string_range", "time_exponent", "rise_s",
                     "full_height_m", "height_exponent"},
                    problems};
        case Kind::Finger:
            break;
    }
    return {value,
            path,
            {"name", "kind", "position_from_bridge_m", "position_share", "width_m", "velocity_range",
             "string_range", "time_exponent", "rise_s", "release_s", "full_height_m", "height_exponent",
             "damping_kg_per_s", "roughness"},
            problems};
}

}  // namespace

ExciterDescription read_exciter(const Value& value, const std::string& path, Problems& problems) {
    const Kind kind = kind_of(value, path, problems);
    Section reader = section_of(kind, value, path, problems);
    ExciterDescription exciter;
    exciter.name = reader.text("name");
    if (kind != Kind::Tangent) exciter.place = reader.place();
    exciter.width_m = reader.number_or("width_m", exciter.width_m);
    exciter.time_exponent = reader.number_or("time_exponent", exciter.time_exponent);
    const auto velocities =
        reader.pair_or("velocity_range", {exciter.lowest_velocity, exciter.highest_velocity});
    exciter.lowest_velocity = velocities.first;
    exciter.highest_velocity = velocities.second;
    if (reader.has("string_range")) {
        const auto range = reader.indices_or_empty("string_range", 2);
        if (range.size() == 2) {
            exciter.first_string = range[0];
            exciter.last_string = range[1];
        } else {
            problems.add(reader.path_of("string_range"), std::to_string(range.size()) + " numbers",
                         "two indices: first and last string");
        }
    }
    switch (kind) {
        case Kind::Finger:
            exciter.body = finger(reader);
            break;
        case Kind::Hammer:
            exciter.body = hammer(reader);
            break;
        case Kind::Tangent:
            exciter.body = tangent(reader);
            break;
    }
    return exciter;
}

HandDescription read_hand(const Value& value, const std::string& path, Problems& problems) {
    Section reader(value, path,
                   {"damps", "release_places", "release_t60_s", "release_spread", "release_noise_N",
                    "release_noise_s", "palm_place", "palm_t60_s", "dead_t60_s", "harmonic_t60_s",
                    "harmonic_touch_s", "legato_level", "pressure_semitones", "course_delay_s"},
                   problems);
    HandDescription hand;
    hand.damps = reader.flag_or("damps", hand.damps);
    if (reader.has("release_places")) {
        const auto places = read_list(reader, "release_places", 2, read_place);
        if (places.size() == 2) {
            hand.release_places = {places[0], places[1]};
        } else {
            problems.add(reader.path_of("release_places"), std::to_string(places.size()) + " places", "two");
        }
    }
    if (const Value* palm = reader.find("palm_place"))
        hand.palm_place = read_place(*palm, reader.path_of("palm_place"), problems);
    hand.release_t60_s = reader.number_or("release_t60_s", hand.release_t60_s);
    hand.release_spread = reader.number_or("release_spread", hand.release_spread);
    hand.release_noise_N = reader.number_or("release_noise_N", hand.release_noise_N);
    hand.release_noise_s = reader.number_or("release_noise_s", hand.release_noise_s);
    hand.palm_t60_s = reader.number_or("palm_t60_s", hand.palm_t60_s);
    hand.dead_t60_s = reader.number_or("dead_t60_s", hand.dead_t60_s);
    hand.harmonic_t60_s = reader.number_or("harmonic_t60_s", hand.harmonic_t60_s);
    hand.harmonic_touch_s = reader.number_or("harmonic_touch_s", hand.harmonic_touch_s);
    hand.legato_level = reader.number_or("legato_level", hand.legato_level);
    hand.pressure_semitones = reader.number_or("pressure_semitones", hand.pressure_semitones);
    hand.course_delay_s = reader.number_or("course_delay_s", hand.course_delay_s);
    return hand;
}

}  // namespace jawari::host::preset
