#include "scenes.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "formats/scene/read_scene.h"
#include "jawari/scene/obstacles.h"

namespace jawari::benchmarks {
namespace {

struct GuitarString {
    double pitch_hz;
    double density_kg_per_m;
};

constexpr std::array<GuitarString, 6> guitar_strings{{{329.63, 4.0e-4},
                                                      {246.94, 7.0e-4},
                                                      {196.00, 1.4e-3},
                                                      {146.83, 2.6e-3},
                                                      {110.00, 4.5e-3},
                                                      {82.41, 7.1e-3}}};
constexpr double scale_m = 0.648;
constexpr double inharmonicity = 4e-5;

/// Modes below `highest_hz`: k f sqrt(1 + B k^2) <= highest.
std::size_t modes_below(double highest_hz, double pitch_hz) {
    const double ratio = highest_hz / pitch_hz;
    const double k2 = (std::sqrt(1 + 4 * inharmonicity * ratio * ratio) - 1) / (2 * inharmonicity);
    return static_cast<std::size_t>(std::sqrt(k2));
}

StringDescription guitar_string(const GuitarString& string, double highest_mode_hz) {
    StringDescription description;
    description.length_m = scale_m;
    description.linear_density_kg_per_m = string.density_kg_per_m;
    PhysicalModes modes;
    modes.count = modes_below(highest_mode_hz, string.pitch_hz);
    modes.tension_N = string.density_kg_per_m * std::pow(2 * scale_m * string.pitch_hz, 2);
    modes.inharmonicity = inharmonicity;
    modes.damping = DecayTimePoints{{{{100, 8.0}, {5000, 0.8}}}};
    description.modes = modes;
    std::array<double, 22> heights{};
    for (std::size_t fret = 1; fret <= heights.size(); ++fret) {
        // From the nut, half a millimetre above the first fret, to 2 mm above the twelfth.
        heights[fret - 1] = -0.4e-3 - 3.2e-3 * equal_temperament_position(1, fret);
    }
    description.contacts = equal_temperament_frets(scale_m, heights, 0);
    description.initial.shape = Pluck{0.8 * scale_m, 2.5e-3};
    description.probes.push_back({Quantity::Velocity, 0.95 * scale_m, 0});
    return description;
}

}  // namespace

SceneDescription builtin(const std::string& name, double output_rate_hz, double contact_rate_hz,
                         ImpactLaw law, double restitution) {
    auto scene = host::load_scene(name);
    if (!scene) throw std::runtime_error(scene.error().message);
    SceneDescription description = scene.value().description;
    description.output_rate_hz = output_rate_hz;
    description.contact_rate_hz = contact_rate_hz;
    description.law = law;
    for (auto& string : description.strings) {
        for (auto& contact : string.contacts) contact.restitution = restitution;
    }
    return description;
}

SceneDescription guitar(std::size_t strings, double output_rate_hz, double contact_rate_hz,
                        double highest_mode_hz) {
    SceneDescription description;
    description.output_rate_hz = output_rate_hz;
    description.contact_rate_hz = contact_rate_hz;
    description.law = ImpactLaw::Signorini;
    for (std::size_t s = 0; s < strings; ++s) {
        description.strings.push_back(
            guitar_string(guitar_strings[s % guitar_strings.size()], highest_mode_hz));
    }
    return description;
}

SceneDescription held_guitar(Hold hold, double output_rate_hz) {
    SceneDescription description = guitar(6, output_rate_hz, output_rate_hz, 8.4e4);
    for (std::size_t s = 0; s < description.strings.size(); ++s) {
        std::vector<ContactDescription>& contacts = description.strings[s].contacts;
        if (hold == Hold::Pressed) {
            const std::size_t fret = 3 + 2 * s;  // 3, 5, ... 13
            const double between = (contacts[fret - 2].position_m + contacts[fret - 1].position_m) / 2;
            const double top = std::min(contacts[fret - 2].height_m, contacts[fret - 1].height_m);
            contacts.push_back({between, top - 3e-4, 0, Side::Above});
        } else if (hold == Hold::OnAllFrets) {
            for (ContactDescription& fret : contacts) {
                const double x = fret.position_m / scale_m;
                fret.height_m = 6e-3 * x * (1 - x);
            }
        }
    }
    return description;
}

}  // namespace jawari::benchmarks
