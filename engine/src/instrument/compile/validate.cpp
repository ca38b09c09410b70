#include "instrument/compile/validate.h"

#include <algorithm>
#include <cmath>

#include "instrument/model/stops.h"

namespace jawari::detail {
namespace {

Check check_string_list(const std::string& place, const std::vector<std::size_t>& list, std::size_t strings) {
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (list[i] < strings) continue;
        return Failure{indexed_place(place, i), std::to_string(list[i]),
                       "0 to " + std::to_string(strings - 1) + ", an index of the strings"};
    }
    return {};
}

Check check_rising(const std::string& place, const std::vector<double>& values, double low, double high) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double floor = i == 0 ? low : values[i - 1];
        if (values[i] > floor && values[i] < high) continue;
        return Failure{indexed_place(place, i), printed(values[i]),
                       "above " + printed(floor) + " and below " + printed(high)};
    }
    return {};
}

Check check_list_length(const std::string& place, std::size_t length, std::size_t count) {
    if (length == 0 || length == count) return {};
    return Failure{place, std::to_string(length) + " entries", std::to_string(count) + ", one for each fret"};
}

/// Pressing fret f must leave every later fret below the line from its top to the bridge.
Check check_heights(const std::string& place, const InstrumentStringDescription& string,
                    const FretsDescription& frets) {
    const std::string heights = place + "height_m";
    for (std::size_t j = 0; j < frets.height_m.size(); ++j) {
        const double height = frets.height_m[j];
        if (!(height >= -0.1)) return Failure{indexed_place(heights, j), printed(height), "-0.1 or more"};
        const double length_m = described_length(string, frets, j + 1);
        double lowest_line = 0;
        for (std::size_t f = 0; f < j; ++f) {
            const double line = frets.height_m[f] * length_m / described_length(string, frets, f + 1);
            lowest_line = std::min(lowest_line, line);
        }
        if (height < lowest_line) continue;
        return Failure{
            indexed_place(heights, j), printed(height),
            "below " + printed(lowest_line) + ", the lowest line from an earlier fret's top to the bridge"};
    }
    return {};
}

Check check_frets(const std::string& place, const InstrumentStringDescription& string,
                  const FretsDescription& frets) {
    if (auto failure = checks::check_count(place + "count", frets.count, 0, limits::frets)) return failure;
    if (auto failure = checks::check(place + "restitution", frets.restitution, {0, 1})) return failure;
    if (auto failure = check_list_length(place + "semitones", frets.semitones.size(), frets.count))
        return failure;
    if (auto failure =
            check_list_length(place + "position_from_nut_m", frets.position_from_nut_m.size(), frets.count))
        return failure;
    if (auto failure = check_list_length(place + "height_m", frets.height_m.size(), frets.count))
        return failure;
    const std::vector<double> semitones(frets.semitones.begin(), frets.semitones.end());
    if (auto failure = check_rising(place + "semitones", semitones, 0, 128)) return failure;
    if (auto failure = check_rising(place + "position_from_nut_m", frets.position_from_nut_m, 0,
                                    0.999 * string.length_m))
        return failure;
    return check_heights(place, string, frets);
}

Check check_string(const std::string& place, const InstrumentDescription& instrument,
                   const InstrumentStringDescription& s) {
    if (auto failure =
            check_values(place + ".", {{"open_note", static_cast<double>(s.open_note), 0, 127},
                                       {"open_frequency_hz", s.open_frequency_hz, 10, 5000},
                                       {"length_m", s.length_m, 0.02, 5},
                                       {"linear_density_kg_per_m", s.linear_density_kg_per_m, 1e-5, 0.1},
                                       {"inharmonicity", s.inharmonicity, 0, 0.01},
                                       {"level", s.level, 0, 100},
                                       {"excitation", s.excitation, 0.01, 100},
                                       {"pan", s.pan, -1, 1}}))
        return failure;
    if (s.course && *s.course >= instrument.strings.size()) {
        return Failure{place + ".course", std::to_string(*s.course), "less than the number of strings"};
    }
    if (s.release_t60_s != 0) {
        if (auto failure = checks::check(place + ".release_t60_s", s.release_t60_s, {0.005, 60}))
            return failure;
    }
    const FretsDescription& frets = frets_of(instrument, s);
    if (auto failure = check_frets(s.frets ? place + ".frets." : "frets.", s, frets)) return failure;
    const int highest = s.open_note + semitones_of(frets, frets.count);
    if (highest <= 127) return {};
    return Failure{place + ".open_note", std::to_string(s.open_note),
                   "0 to 127 minus the highest fret's semitones"};
}

Check check_profile(const std::string& place, const ObstacleDescription& obstacle) {
    if (const auto* parabola = std::get_if<ParabolicProfile>(&obstacle.profile)) {
        if (obstacle.points == 0) return Failure{place + "points", "0", "1 or more with a parabola"};
        if (!(parabola->length_m > 0))
            return Failure{place + "parabola.length_m", printed(parabola->length_m), "above 0, to 5"};
        return check_values(place + "parabola.", {{"length_m", parabola->length_m, 0, 5},
                                                  {"drop_m", parabola->drop_m, 0, 0.1},
                                                  {"height_m", parabola->height_m, -0.1, 0.1}});
    }
    const auto& corners = std::get<CornerProfile>(obstacle.profile);
    if (auto failure = checks::check_count(place + "profile_m", corners.size(), 1, limits::obstacle_points))
        return failure;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::string corner = indexed_place(place + "profile_m", i);
        const double from = i == 0 ? 0 : corners[i - 1].first;
        if (!(corners[i].first >= from && corners[i].first <= 5) || (i > 0 && corners[i].first == from))
            return Failure{corner + "[0]", printed(corners[i].first), "rising distances from 0 to 5"};
        if (auto failure = checks::check(corner + "[1]", corners[i].second, {-0.1, 0.1})) return failure;
    }
    return {};
}

Check check_obstacles(const InstrumentDescription& instrument) {
    const auto& list = instrument.obstacles;
    if (auto failure = checks::check_count("obstacles", list.size(), 0, limits::obstacles)) return failure;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string place = indexed_place("obstacles", i) + ".";
        if (auto failure = checks::check_count(place + "points", list[i].points, 0, limits::obstacle_points))
            return failure;
        if (auto failure = check_profile(place, list[i])) return failure;
        if (auto failure = checks::check(place + "restitution", list[i].restitution, {0, 1})) return failure;
        if (auto failure = check_string_list(place + "strings", list[i].strings, instrument.strings.size()))
            return failure;
    }
    return {};
}

Check check_soft_touches(const InstrumentDescription& instrument, double shortest_m) {
    const auto& list = instrument.soft_touches;
    std::vector<std::size_t> touches(instrument.strings.size(), 0);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string place = indexed_place("soft_touches", i);
        if (auto failure = check_place(place, list[i].place, shortest_m)) return failure;
        if (auto failure =
                check_values(place + ".", {{"width_m", list[i].width_m, 0, 0.2},
                                           {"damping_kg_per_s", list[i].damping_kg_per_s, 0, 1e4},
                                           {"stiffness_N_per_m", list[i].stiffness_N_per_m, 0, 1e7}}))
            return failure;
        if (auto failure = check_string_list(place + ".strings", list[i].strings, instrument.strings.size()))
            return failure;
        for (std::size_t s = 0; s < touches.size(); ++s) {
            if (applies_to(list[i].strings, s)) touches[s] += 1;
            if (touches[s] <= limits::soft_touches) continue;
            return Failure{place, "another touch on strings[" + std::to_string(s) + "]",
                           "at most " + std::to_string(limits::soft_touches) + " on a string"};
        }
    }
    return {};
}

Check check_tuning(const InstrumentDescription& instrument) {
    const std::vector<double>& table = instrument.note_frequency_hz;
    if (!table.empty() && table.size() != 128)
        return Failure{"tuning", std::to_string(table.size()) + " notes", "128"};
    for (std::size_t n = 0; n < table.size(); ++n) {
        if (std::isnan(table[n]) || (table[n] >= 1 && table[n] <= 20000)) continue;
        return Failure{indexed_place("tuning", n), printed(table[n]), "1 to 20000 Hz"};
    }
    return {};
}

Check check_quality(const std::string& prefix, const QualityDescription& quality) {
    return check_values(prefix,
                        {{"contact_rate_min_hz", quality.contact_rate_min_hz, 8000, 1e8},
                         {"mode_limit_hz", quality.mode_limit_hz, 10, 0.45 * quality.contact_rate_min_hz}});
}

}  // namespace

Check check_values(const std::string& prefix, std::initializer_list<CheckedValue> values) {
    for (const CheckedValue& v : values) {
        if (auto failure = checks::check(prefix + v.name, v.value, {v.low, v.high})) return failure;
    }
    return {};
}

Check check_place(const std::string& place, const StringPlace& value, double shortest_m) {
    if (value.share != 0) {
        if (value.share > 0 && value.share < 1) return {};
        return Failure{place + ".position_share", printed(value.share), "between 0 and 1, ends excluded"};
    }
    if (value.from_bridge_m > 0 && value.from_bridge_m < shortest_m) return {};
    return Failure{place + ".position_from_bridge_m", printed(value.from_bridge_m),
                   "between 0 and the shortest speaking length, " + printed(shortest_m) + ", ends excluded"};
}

}  // namespace jawari::detail

namespace jawari {

std::optional<Failure> validate(const InstrumentDescription& instrument, double output_rate_hz) {
    using namespace detail;
    if (auto failure = checks::check("output rate", output_rate_hz, {8000, 1e6})) return failure;
    if (auto failure = checks::check("gain", instrument.gain, {0, 1e6})) return failure;
    if (auto failure = check_quality("", instrument.quality)) return failure;
    if (instrument.studio) {
        if (auto failure = check_quality("studio.", *instrument.studio)) return failure;
    }
    if (auto failure = check_tuning(instrument)) return failure;
    const std::size_t strings = instrument.strings.size();
    if (auto failure = checks::check_count("strings", strings, 1, limits::instrument_strings)) return failure;
    double shortest_m = 5;
    for (std::size_t i = 0; i < strings; ++i) {
        const InstrumentStringDescription& string = instrument.strings[i];
        if (auto failure = check_string(indexed_place("strings", i), instrument, string)) return failure;
        const FretsDescription& frets = frets_of(instrument, string);
        const double string_m = described_length(string, frets, frets.count);
        if (string.exciter_place) {
            const std::string place = indexed_place("strings", i) + ".exciter_place";
            if (auto failure = check_place(place, *string.exciter_place, string_m)) return failure;
        }
        shortest_m = std::min(shortest_m, string_m);
    }
    if (auto failure = check_obstacles(instrument)) return failure;
    if (auto failure = check_soft_touches(instrument, shortest_m)) return failure;
    if (auto failure = validate_players(instrument, shortest_m)) return failure;
    return validate_output(instrument, shortest_m);
}

}  // namespace jawari
