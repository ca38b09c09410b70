// A small valid scene as JSON text, to be changed by tests.
#pragma once

#include <stdexcept>
#include <string>

namespace jawari::test {

inline const char* const valid_scene = R"({
 "schema": "jawari.scene/1",
 "duration_s": 0.01,
 "output_rate_hz": 8000,
 "contact_rate_hz": 80000,
 "scheme": "exact",
 "law": "newton",
 "strings": [
  {
   "name": "test",
   "length_m": 0.8,
   "linear_density_kg_per_m": 0.005,
   "modes": {"count": 20, "tension_N": 100, "inharmonicity": 1e-5, "inharmonicity_law": "square_root",
             "damping": {"model": "t60", "points": [{"frequency_hz": 100, "t60_s": 3}, {"frequency_hz": 1000, "t60_s": 1}]}},
   "initial": {"pluck": {"position_m": 0.3, "height_m": 0.002}, "start": "exact"},
   "contacts": [{"position_m": 0.2, "height_m": -0.0005, "restitution": 0.5, "side": "below"},
                {"position_m": 0.5, "height_m": 0.004, "side": "above"}],
   "probes": [{"quantity": "displacement", "position_m": 0.1}, {"quantity": "velocity", "position_m": 0.1},
              {"quantity": "contact_force", "contact": 0}, {"quantity": "energy"}]
  }
 ]
})";

/// The text with `from`, which must occur exactly once, replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    if (at == std::string::npos || text.find(from, at + 1) != std::string::npos)
        throw std::runtime_error("not exactly once: " + from);
    return text.replace(at, from.size(), to);
}

}  // namespace jawari::test
