// How far modes run from their closed form in very many steps.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace jawari::soak {

/// Step by step, or whole frames by their closed form P^m (docs/engine/model.md).
enum class Advance { Steps, Frames };

/// Against the exact solution at the model's own omega, sigma and h, in 100-digit arithmetic.
struct ModeDrift {
    double frequency_hz = 0;
    double decay_per_s = 0;
    double phase_rad = 0;  ///< error of the phase
    double amplitude = 0;  ///< relative error of the amplitude
};

struct PhaseDrift {
    std::uint64_t steps = 0;  ///< whole frames of them
    double contact_rate_hz = 0;
    std::vector<ModeDrift> modes;

    [[nodiscard]] double worst_phase_rad() const;
    [[nodiscard]] double worst_amplitude() const;
};

/// Sixteen modes from 20 Hz to 20 kHz, half of them without loss, at 2.016 million steps a second. Ends early
/// when `goes_on`, asked now and then with the steps done, says no.
PhaseDrift run_phase_drift(std::uint64_t steps, Advance advance,
                           const std::function<bool(std::uint64_t done)>& goes_on);

}  // namespace jawari::soak
