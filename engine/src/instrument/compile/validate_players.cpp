// The parts of an instrument that excite, damp and listen.
#include "instrument/compile/validate.h"

namespace jawari::detail {
namespace {

Check check_body(const std::string& place, const FingerDescription& finger) {
    return check_values(place, {{"rise_s", finger.rise_s, 1e-4, 0.1},
                                {"release_s", finger.release_s, 5e-5, 0.1},
                                {"full_height_m", finger.full_height_m, 1e-6, 0.02},
                                {"height_exponent", finger.height_exponent, 0.1, 4},
                                {"damping_kg_per_s", finger.damping_kg_per_s, 0, 100},
                                {"roughness", finger.roughness, 0, 1}});
}

Check check_body(const std::string& place, const HammerDescription& hammer) {
    return check_values(place, {{"mass_kg", hammer.mass_kg, 1e-5, 1},
                                {"stiffness", hammer.stiffness, 1, 1e15},
                                {"exponent", hammer.exponent, 1, 5},
                                {"loss_s_per_m", hammer.loss_s_per_m, 0, 10},
                                {"full_speed_m_per_s", hammer.full_speed_m_per_s, 0.01, 50},
                                {"speed_exponent", hammer.speed_exponent, 0.1, 4}});
}

Check check_body(const std::string& place, const TangentDescription& tangent) {
    return check_values(place, {{"rise_s", tangent.rise_s, 2e-4, 0.1},
                                {"full_height_m", tangent.full_height_m, 1e-6, 0.02},
                                {"height_exponent", tangent.height_exponent, 0.1, 4}});
}

Check check_exciter(const std::string& place, const ExciterDescription& exciter, double shortest_m) {
    const bool tangent = std::holds_alternative<TangentDescription>(exciter.body);
    if (!tangent) {
        if (auto failure = check_place(place, exciter.place, shortest_m)) return failure;
    }
    const std::string prefix = place + ".";
    if (auto failure = check_values(
            prefix, {{"width_m", exciter.width_m, 0, 0.1},
                     {"time_exponent", exciter.time_exponent, 0, 2},
                     {"velocity_range[0]", exciter.lowest_velocity, 0, 1},
                     {"velocity_range[1]", exciter.highest_velocity, exciter.lowest_velocity, 1}}))
        return failure;
    if (exciter.last_string < exciter.first_string) {
        return Failure{place + ".string_range[1]", std::to_string(exciter.last_string),
                       std::to_string(exciter.first_string) + " or more"};
    }
    return std::visit([&](const auto& body) { return check_body(prefix, body); }, exciter.body);
}

Check check_hand(const HandDescription& hand, double shortest_m) {
    for (std::size_t i = 0; i < hand.release_places.size(); ++i) {
        if (auto failure =
                check_place(indexed_place("hand.release_places", i), hand.release_places[i], shortest_m))
            return failure;
    }
    if (auto failure = check_place("hand.palm_place", hand.palm_place, shortest_m)) return failure;
    return check_values("hand.", {{"release_t60_s", hand.release_t60_s, 0.005, 60},
                                  {"release_spread", hand.release_spread, 1, 10},
                                  {"release_noise_N", hand.release_noise_N, 0, 100},
                                  {"release_noise_s", hand.release_noise_s, 0.001, 1},
                                  {"palm_t60_s", hand.palm_t60_s, 0.005, 60},
                                  {"dead_t60_s", hand.dead_t60_s, 0.005, 60},
                                  {"harmonic_t60_s", hand.harmonic_t60_s, 0.005, 60},
                                  {"harmonic_touch_s", hand.harmonic_touch_s, 0.001, 5},
                                  {"legato_level", hand.legato_level, 0, 1},
                                  {"pressure_semitones", hand.pressure_semitones, -12, 12},
                                  {"course_delay_s", hand.course_delay_s, 0, 0.05}});
}

}  // namespace

Check validate_players(const InstrumentDescription& instrument, double shortest_m) {
    const auto& exciters = instrument.exciters;
    if (auto failure = checks::check_count("exciters", exciters.size(), 1, limits::exciters)) return failure;
    for (std::size_t i = 0; i < exciters.size(); ++i) {
        if (auto failure = check_exciter(indexed_place("exciters", i), exciters[i], shortest_m))
            return failure;
    }
    return check_hand(instrument.hand, shortest_m);
}

Check check_shape(const std::string& place, const std::vector<double>& shape, std::size_t strings) {
    if (!shape.empty() && shape.size() != strings)
        return Failure{place, std::to_string(shape.size()) + " numbers",
                       std::to_string(strings) + ", one for each string"};
    for (std::size_t s = 0; s < shape.size(); ++s) {
        if (auto failure = checks::check(indexed_place(place, s), shape[s], {-100, 100})) return failure;
    }
    return {};
}

Check validate_output(const InstrumentDescription& instrument, double shortest_m) {
    const auto& pickups = instrument.pickups;
    if (auto failure = checks::check_count("pickups", pickups.size(), 0, limits::pickups)) return failure;
    for (std::size_t i = 0; i < pickups.size(); ++i) {
        const std::string place = indexed_place("pickups", i);
        if (pickups[i].quantity != PickupQuantity::BridgeForce) {
            if (auto failure = check_place(place, pickups[i].place, shortest_m)) return failure;
        }
        if (auto failure =
                check_values(place + ".", {{"width_m", pickups[i].width_m, 0, 0.1},
                                           {"level", pickups[i].level, -100, 100},
                                           {"magnet_distance_m", pickups[i].magnet_distance_m, 0, 0.1},
                                           {"quality_factor", pickups[i].quality_factor, 0.2, 20}}))
            return failure;
        if (pickups[i].resonance_hz == 0) continue;
        if (auto failure = check_values(place + ".", {{"resonance_hz", pickups[i].resonance_hz, 50, 20000}}))
            return failure;
    }
    const auto& body = instrument.body;
    if (auto failure = checks::check_count("body", body.size(), 0, limits::body_modes)) return failure;
    std::size_t moving = 0;
    for (std::size_t i = 0; i < body.size(); ++i) {
        if (auto failure = check_values(indexed_place("body", i) + ".",
                                        {
                                            {"frequency_hz", body[i].frequency_hz, 5, 20000},
                                            {"t60_s", body[i].t60_s, 1e-4, 20},
                                            {"gain_left", body[i].gain_left, -1e6, 1e6},
                                            {"gain_right", body[i].gain_right, -1e6, 1e6},
                                        }))
            return failure;
        if (body[i].mass_kg != 0) {
            if (auto failure =
                    checks::check(indexed_place("body", i) + ".mass_kg", body[i].mass_kg, {1e-4, 1e4}))
                return failure;
            ++moving;
        }
        if (auto failure =
                check_shape(indexed_place("body", i) + ".shape", body[i].shape, instrument.strings.size()))
            return failure;
    }
    if (instrument.bridge) {
        if (auto failure = checks::check("bridge.open_strings", instrument.bridge->open_strings, {0, 1}))
            return failure;
    }
    if (instrument.bridge && (moving == 0 || moving > limits::moving_body_modes))
        return Failure{"body", std::to_string(moving) + " modes with mass",
                       "1 to " + std::to_string(limits::moving_body_modes) + " where the bridge moves"};
    if (!pickups.empty() || !body.empty()) return {};
    return Failure{"pickups", "none", "at least one pickup, or a body"};
}

}  // namespace jawari::detail
