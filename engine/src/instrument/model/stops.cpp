#include "instrument/model/stops.h"
#include "base/assert.h"
#include "base/square.h"
#include "instrument/model/body_on_string.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace jawari {
namespace {

bool uses_tuning(const InstrumentDescription& instrument) {
    return !instrument.note_frequency_hz.empty();
}

double open_frequency(const InstrumentDescription& instrument, const InstrumentStringDescription& string) {
    return note_frequency(instrument, string, 0);
}

double speaking_length(const InstrumentDescription& instrument, const InstrumentStringDescription& string,
                       std::size_t fret) {
    if (fret == 0) return string.length_m;
    if (uses_tuning(instrument) && instrument.tuning_moves_frets) {
        const double open = open_frequency(instrument, string);
        const double ratio = open / note_frequency(instrument, string, fret);
        if (ratio > 0 && ratio < 1) return string.length_m * ratio;
    }
    return described_length(string, frets_of(instrument, string), fret);
}

struct Stiffness {
    double inharmonicity = 0;  ///< B_f
    double tension_N = 0;      ///< T_f
};

/// Bending stiffness K = pi^2 E I = B T L^2 belongs to the string, not to the fret. With the first partial at
/// f = f_0 sqrt(1+B_f) and T_f = mu (2 L_f f_0)^2 it follows that B_f/(1+B_f) = K/(4 mu L_f^4 f^2): solved
/// exactly.
Stiffness stiffness_at(const InstrumentStringDescription& string, double length_m, double frequency_hz) {
    const double open = string.inharmonicity / (1 + string.inharmonicity);
    const double stopped = std::min(0.5, open * square(square(string.length_m / length_m)) *
                                             square(string.open_frequency_hz / frequency_hz));
    const double inharmonicity = stopped / (1 - stopped);
    const double fundamental_hz = frequency_hz / std::sqrt(1 + inharmonicity);
    return {inharmonicity, string.linear_density_kg_per_m * square(2 * length_m * fundamental_hz)};
}

std::size_t modes_up_to(double limit_hz, double first_partial_hz, double inharmonicity) {
    const double fundamental_hz = first_partial_hz / std::sqrt(1 + inharmonicity);
    std::size_t count = 1;
    while (count <= limits::instrument_modes) {
        const double k = static_cast<double>(count + 1);
        if (k * fundamental_hz * std::sqrt(1 + inharmonicity * k * k) > limit_hz) break;
        ++count;
    }
    return count;
}

double height_of(const CornerProfile& corners, double distance) {
    if (distance <= corners.front().first) return corners.front().second;
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const auto& [x0, y0] = corners[i - 1];
        const auto& [x1, y1] = corners[i];
        if (distance <= x1) return y0 + (y1 - y0) * (distance - x0) / (x1 - x0);
    }
    return corners.back().second;
}

double height_of(const ParabolicProfile& parabola, double distance) {
    return parabola.height_m - parabola.drop_m * square(distance / parabola.length_m);
}

double height_of(const ObstacleDescription& obstacle, double distance) {
    return std::visit([&](const auto& profile) { return height_of(profile, distance); }, obstacle.profile);
}

std::pair<double, double> extent_of(const ObstacleDescription& obstacle) {
    if (const auto* parabola = std::get_if<ParabolicProfile>(&obstacle.profile))
        return {0.0, parabola->length_m};
    const auto& corners = std::get<CornerProfile>(obstacle.profile);
    return {corners.front().first, corners.back().first};
}

/// Where the string lies when it is stopped: the line from the stop's top to the bridge.
struct Stop {
    double length_m = 0;    ///< speaking length
    double from_nut_m = 0;  ///< of the stop
    double height_m = 0;    ///< of the stop's top from the open string's rest line
};

/// A stop without a fret of known height lies on the neck, if there is one.
double stop_height(const InstrumentDescription& instrument, std::size_t index, const FretsDescription& frets,
                   std::size_t fret, double from_nut_m) {
    if (fret == 0) return 0;
    if (!frets.height_m.empty()) return frets.height_m[fret - 1];
    double height = -1;
    for (const ObstacleDescription& obstacle : instrument.obstacles) {
        if (obstacle.origin != Origin::Nut || obstacle.side != Side::Below ||
            !applies_to(obstacle.strings, index))
            continue;
        const auto [first, last] = extent_of(obstacle);
        if (from_nut_m < first || from_nut_m > last || first == last) continue;
        height = std::max(height, height_of(obstacle, from_nut_m));
    }
    return height > -1 ? std::min(height, 0.0) : 0.0;
}

/// A contact, and whether it belongs to the neck, whose distance the player may adjust.
struct PlacedContact {
    ContactDescription contact;
    bool on_neck = false;
};

void add_contact(std::vector<PlacedContact>& contacts, const ObstacleDescription& obstacle, const Stop& stop,
                 double distance, double x) {
    if (!(x > 0 && x < stop.length_m)) return;
    const double to_bridge = stop.length_m - x;
    const double line = obstacle.origin == Origin::Stop ? 0.0 : stop.height_m * to_bridge / stop.length_m;
    contacts.push_back({{x, height_of(obstacle, distance) - line, obstacle.restitution, obstacle.side},
                        obstacle.origin == Origin::Nut && obstacle.side == Side::Below});
}

double distance_of(const ObstacleDescription& obstacle, const Stop& stop, double x) {
    switch (obstacle.origin) {
        case Origin::Bridge:
            return stop.length_m - x;
        case Origin::Nut:
            return stop.from_nut_m + x;
        case Origin::Stop:
            break;
    }
    return x;
}

double place_of(const ObstacleDescription& obstacle, const Stop& stop, double distance) {
    switch (obstacle.origin) {
        case Origin::Bridge:
            return stop.length_m - distance;
        case Origin::Nut:
            return distance - stop.from_nut_m;
        case Origin::Stop:
            break;
    }
    return distance;
}

/// Spread contacts lie on nodes j L/M, so that the response depends on differences and sums of j alone.
void add_spread_contacts(std::vector<PlacedContact>& contacts, const ObstacleDescription& obstacle,
                         const Stop& stop) {
    const auto [first, last] = extent_of(obstacle);
    const double spacing = (last - first) / static_cast<double>(obstacle.points);
    if (!(spacing > 0)) {
        add_contact(contacts, obstacle, stop, first, place_of(obstacle, stop, first));
        return;
    }
    const double intervals = std::max(2.0, std::round(stop.length_m / spacing));
    const std::size_t most = std::min(obstacle.points, limits::obstacle_points);
    std::size_t added = 0;
    for (double j = 1; j < intervals && added < most; ++j) {
        const double x = j * stop.length_m / intervals;
        const double distance = distance_of(obstacle, stop, x);
        if (distance < first || distance > last) continue;
        add_contact(contacts, obstacle, stop, distance, x);
        ++added;
    }
}

std::vector<PlacedContact> contacts_at(const InstrumentDescription& instrument, std::size_t index,
                                       std::size_t fret) {
    const InstrumentStringDescription& string = instrument.strings[index];
    const FretsDescription& frets = frets_of(instrument, string);
    Stop stop;
    stop.length_m = speaking_length(instrument, string, fret);
    stop.from_nut_m = string.length_m - stop.length_m;
    stop.height_m = stop_height(instrument, index, frets, fret, stop.from_nut_m);
    std::vector<PlacedContact> contacts;
    if (!instrument.contacts) return contacts;
    for (std::size_t j = fret + 1; j <= frets.height_m.size(); ++j) {
        const double to_bridge = speaking_length(instrument, string, j);
        if (!(to_bridge < stop.length_m)) continue;
        const double height = frets.height_m[j - 1] - stop.height_m * to_bridge / stop.length_m;
        contacts.push_back({{stop.length_m - to_bridge, height, frets.restitution, Side::Below}, true});
    }
    for (const ObstacleDescription& obstacle : instrument.obstacles) {
        if (!applies_to(obstacle.strings, index)) continue;
        if (obstacle.points > 0) {
            add_spread_contacts(contacts, obstacle, stop);
            continue;
        }
        for (const auto& corner : std::get<CornerProfile>(obstacle.profile))
            add_contact(contacts, obstacle, stop, corner.first, place_of(obstacle, stop, corner.first));
    }
    std::stable_sort(contacts.begin(), contacts.end(), [](const auto& a, const auto& b) {
        return a.contact.position_m < b.contact.position_m;
    });
    return contacts;
}

/// Without contacts.
StringDescription tuned_string(const InstrumentDescription& instrument, std::size_t index, std::size_t fret,
                               double frequency_hz) {
    const InstrumentStringDescription& string = instrument.strings[index];
    StringDescription stopped;
    stopped.name = string.name;
    stopped.length_m = speaking_length(instrument, string, fret);
    stopped.linear_density_kg_per_m = string.linear_density_kg_per_m;
    const Stiffness stiffness = stiffness_at(string, stopped.length_m, frequency_hz);
    PhysicalModes modes;
    modes.count = modes_up_to(instrument.quality.mode_limit_hz, frequency_hz, stiffness.inharmonicity);
    modes.tension_N = stiffness.tension_N;
    modes.inharmonicity = stiffness.inharmonicity;
    modes.damping = string.damping;
    stopped.modes = modes;
    return stopped;
}

/// How often the tension is corrected at most, and the share of the frequency that may be missing: near a
/// resonance of the body the partial follows its string by a part of the way.
constexpr int corrections = 60;
constexpr double close_enough = 1e-6;

/// The string whose first partial has that frequency with the body, and which loses with it what it is said
/// to lose. `rigid`: the same on a rigid bridge.
StringDescription tuned_on_bridge(const InstrumentDescription& instrument, std::size_t index,
                                  std::size_t fret, StringDescription rigid) {
    const std::vector<double> losses = body_losses(instrument, index, rigid);
    const double wanted_hz = note_frequency(instrument, instrument.strings[index], fret);
    double frequency_hz = wanted_hz;
    for (int i = 0; i < corrections; ++i) {
        rigid = tuned_string(instrument, index, fret, frequency_hz);
        std::get<PhysicalModes>(rigid.modes).lost_elsewhere_per_s = losses;
        const double coupled_hz = coupled_first_partial(instrument, index, rigid);
        if (!(coupled_hz > 0.5 * wanted_hz && coupled_hz < 2 * wanted_hz)) break;
        if (std::abs(coupled_hz - wanted_hz) < close_enough * wanted_hz) break;
        frequency_hz *= wanted_hz / coupled_hz;
    }
    return rigid;
}

}  // namespace

int semitones_of(const FretsDescription& frets, std::size_t fret) {
    if (fret == 0) return 0;
    return frets.semitones.empty() ? static_cast<int>(fret) : frets.semitones[fret - 1];
}

double described_length(const InstrumentStringDescription& string, const FretsDescription& frets,
                        std::size_t fret) {
    if (fret == 0) return string.length_m;
    if (!frets.position_from_nut_m.empty()) return string.length_m - frets.position_from_nut_m[fret - 1];
    return string.length_m * std::exp2(-static_cast<double>(semitones_of(frets, fret)) / 12);
}

double note_frequency(const InstrumentDescription& instrument, const InstrumentStringDescription& string,
                      std::size_t fret) {
    const int semitones = semitones_of(frets_of(instrument, string), fret);
    if (uses_tuning(instrument))
        return instrument.note_frequency_hz[static_cast<std::size_t>(string.open_note) +
                                            static_cast<std::size_t>(semitones)];
    return string.open_frequency_hz * std::exp2(semitones / 12.0);
}

StringDescription stopped_string(const InstrumentDescription& instrument, std::size_t index,
                                 std::size_t fret) {
    JAWARI_ASSERT(index < instrument.strings.size());
    const double frequency_hz = note_frequency(instrument, instrument.strings[index], fret);
    JAWARI_ASSERT(frequency_hz > 0);
    StringDescription stopped = tuned_string(instrument, index, fret, frequency_hz);
    if (instrument.bridge) stopped = tuned_on_bridge(instrument, index, fret, std::move(stopped));
    for (const PlacedContact& placed : contacts_at(instrument, index, fret))
        stopped.contacts.push_back(placed.contact);
    return stopped;
}

std::vector<bool> contacts_on_neck(const InstrumentDescription& instrument, std::size_t index,
                                   std::size_t fret) {
    std::vector<bool> on_neck;
    for (const PlacedContact& placed : contacts_at(instrument, index, fret))
        on_neck.push_back(placed.on_neck);
    return on_neck;
}

}  // namespace jawari
