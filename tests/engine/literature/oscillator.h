// One mode against a rigid stop, in closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "literature/unit_string.h"

namespace jawari::literature {

/// y = A cos(omega (t - t_0) + phi) between impacts; an impact at y = -depth turns the velocity V into -e V,
/// so that A^2 - depth^2 falls by e^2. Starts at rest at `height` above the middle.
class OscillatorOnStop {
  public:
    OscillatorOnStop(double omega, double height, double depth, double restitution, double duration_s)
        : omega_(omega) {
        flights_.push_back({0, height, 0});
        while (flights_.back().begin_s < duration_s) {
            const Flight flight = flights_.back();
            const double impact = flight.begin_s + (angle(depth, flight.amplitude) - flight.phase) / omega;
            const double excess = flight.amplitude * flight.amplitude - depth * depth;
            const double amplitude =
                std::sqrt(depth * depth + restitution * restitution * std::max(0.0, excess));
            flights_.push_back({impact, amplitude, -angle(depth, amplitude)});
        }
    }

    double at(double t) const {
        auto flight = std::upper_bound(flights_.begin(), flights_.end(), t,
                                       [](double time, const Flight& f) { return time < f.begin_s; });
        --flight;
        return flight->amplitude * std::cos(omega_ * (t - flight->begin_s) + flight->phase);
    }
    /// Amplitude of the last flight.
    double last_amplitude() const { return flights_[flights_.size() - 2].amplitude; }

  private:
    struct Flight {
        double begin_s, amplitude, phase;
    };
    static double angle(double depth, double amplitude) {
        return std::acos(std::max(-1.0, -depth / amplitude));
    }

    double omega_;
    std::vector<Flight> flights_;
};

/// The mode's scene: 1 Hz, displaced by 1 at the middle of a unit string, a stop at -0.3 there.
inline SceneDescription oscillator_scene(ImpactLaw law, double restitution, double contact_rate_hz) {
    StringDescription string;
    string.length_m = 1;
    string.linear_density_kg_per_m = 1;
    string.modes = ModeTable{{1.0}, {0.0}};
    string.initial.shape = ModalState{{std::sqrt(0.5)}, {}};
    string.contacts = {{0.5, -0.3, restitution, Side::Below}};
    string.probes = {{Quantity::Displacement, 0.5, 0}, {Quantity::Energy, 0, 0}};
    SceneDescription scene;
    scene.output_rate_hz = 50;
    scene.contact_rate_hz = contact_rate_hz;
    scene.law = law;
    scene.strings.push_back(string);
    return scene;
}

}  // namespace jawari::literature
