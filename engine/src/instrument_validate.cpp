#include "instrument_validate.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "validate.h"

namespace jawari {
namespace {

using Check = std::optional<Failure>;

struct Checked {
    const char* name;
    double value;
    double low;
    double high;
};

Check check(const std::string& place, double value, double low, double high) {
    if (value >= low && value <= high) return {};  // also false for NaN
    return Failure{place, printed(value), printed(low) + " to " + printed(high)};
}

Check check_all(const std::string& prefix, std::initializer_list<Checked> values) {
    for (const Checked& v : values) {
        if (auto failure = check(prefix + v.name, v.value, v.low, v.high)) return failure;
    }
    return {};
}

Check check_count(const std::string& place, std::size_t count, std::size_t low, std::size_t high) {
    if (count >= low && count <= high) return {};
    return Failure{place, std::to_string(count) + " entries",
                   std::to_string(low) + " to " + std::to_string(high)};
}

std::string indexed(const char* list, std::size_t i) {
    return std::string(list) + "[" + std::to_string(i) + "]";
}

Check check_position(const std::string& place, double value, double shortest_m) {
    if (value > 0 && value < shortest_m) return {};
    return Failure{place, printed(value),
                   "between 0 and the shortest speaking length, " + printed(shortest_m) + ", ends excluded"};
}

Check check_string(const std::string& place, const InstrumentStringDescription& s, std::size_t frets) {
    const int highest_open_note = 127 - static_cast<int>(frets);
    return check_all(place + ".",
                     {{"open_note", static_cast<double>(s.open_note), 0, double(highest_open_note)},
                      {"open_frequency_hz", s.open_frequency_hz, 10, 5000},
                      {"length_m", s.length_m, 0.05, 5},
                      {"linear_density_kg_per_m", s.linear_density_kg_per_m, 1e-5, 0.1},
                      {"inharmonicity", s.inharmonicity, 0, 0.01},
                      {"level", s.level, 0, 100}});
}

/// Pressing fret f must leave every later fret below the line from its top to the bridge.
Check check_frets(const FretsDescription& frets) {
    if (auto failure = check_count("frets.height_m", frets.height_m.size(), 0, limits::frets)) return failure;
    if (auto failure = check("frets.restitution", frets.restitution, 0, 1)) return failure;
    for (std::size_t j = 0; j < frets.height_m.size(); ++j) {
        const double height = frets.height_m[j];
        const std::string place = indexed("frets.height_m", j);
        if (!(height >= -0.1)) return Failure{place, printed(height), "-0.1 or more"};
        double lowest_line = 0;
        for (std::size_t f = 0; f < j; ++f) {
            const double line = frets.height_m[f] * speaking_length(1, j - f);
            lowest_line = std::min(lowest_line, line);
        }
        if (!(height < lowest_line)) {
            return Failure{place, printed(height),
                           "below " + printed(lowest_line) +
                               ", the lowest line from an earlier fret's top to the bridge"};
        }
    }
    return {};
}

Check check_pluck(const PluckDescription& pluck, double shortest_m) {
    if (auto failure =
            check_position("pluck.position_from_bridge_m", pluck.position_from_bridge_m, shortest_m)) {
        return failure;
    }
    return check_all("pluck.", {{"rise_s", pluck.rise_s, 1e-4, 0.1},
                                {"release_s", pluck.release_s, 5e-5, 0.1},
                                {"full_height_m", pluck.full_height_m, 1e-6, 0.02},
                                {"height_exponent", pluck.height_exponent, 0.1, 4}});
}

Check check_pickups(const std::vector<PickupDescription>& pickups, double shortest_m) {
    if (auto failure = check_count("pickups", pickups.size(), 1, limits::pickups)) return failure;
    for (std::size_t i = 0; i < pickups.size(); ++i) {
        const std::string place = indexed("pickups", i) + ".";
        if (auto failure = check_position(place + "position_from_bridge_m", pickups[i].position_from_bridge_m,
                                          shortest_m)) {
            return failure;
        }
        if (auto failure = check_all(
                place, {{"width_m", pickups[i].width_m, 0, 0.1}, {"level", pickups[i].level, -100, 100}})) {
            return failure;
        }
    }
    return {};
}

}  // namespace

double speaking_length(double length_m, std::size_t fret) {
    return length_m * std::exp2(-static_cast<double>(fret) / 12);
}

std::optional<Failure> validate(const InstrumentDescription& instrument, double output_rate_hz) {
    if (auto failure = check("output rate", output_rate_hz, 8000, 1e6)) return failure;
    if (auto failure = check_all(
            "", {{"gain", instrument.gain, 0, 1e6},
                 {"contact_rate_min_hz", instrument.contact_rate_min_hz, 8000, 1e8},
                 {"mode_limit_hz", instrument.mode_limit_hz, 10, 0.45 * instrument.contact_rate_min_hz},
                 {"release_t60_s", instrument.release_t60_s, 0.005, 60}})) {
        return failure;
    }
    const std::size_t strings = instrument.strings.size();
    if (auto failure = check_count("strings", strings, 1, limits::instrument_strings)) return failure;
    if (auto failure = check_frets(instrument.frets)) return failure;
    double shortest_m = instrument.strings[0].length_m;
    for (std::size_t i = 0; i < strings; ++i) {
        if (auto failure = check_string(indexed("strings", i), instrument.strings[i],
                                        instrument.frets.height_m.size())) {
            return failure;
        }
        shortest_m = std::min(shortest_m, instrument.strings[i].length_m);
    }
    shortest_m = speaking_length(shortest_m, instrument.frets.height_m.size());
    if (auto failure = check_pluck(instrument.pluck, shortest_m)) return failure;
    return check_pickups(instrument.pickups, shortest_m);
}

}  // namespace jawari
