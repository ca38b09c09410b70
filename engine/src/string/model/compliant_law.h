// The force law of a compliant contact over one step, as a discrete gradient: what it takes from the string
// is stored or lost, never made (docs/engine/stability.md, "Compliant contacts").
#pragma once

#include <algorithm>
#include <cmath>

#include "jawari/scene/description.h"

namespace jawari {

inline bool is_rigid(const Compliance& law) {
    return law.stiffness == 0 && law.resistance_kg_per_s == 0;
}

/// psi(y) = K/(p+1) [-y]^(p+1) [J], y the mean of the gap at two neighbouring steps [m].
inline double stored_energy(const Compliance& law, double mean_gap) {
    if (mean_gap >= 0) return 0;
    return law.stiffness / (law.exponent + 1) * std::pow(-mean_gap, law.exponent + 1);
}

/// (s_end^(p+1) - s_start^(p+1))/((p+1)(s_end - s_start)) for depths s, negative ones counting as 0 in the
/// powers.
inline double mean_power(double start, double end, double exponent) {
    const double degree = exponent + 1;
    if (start <= 0 && end <= 0) return 0;
    if (start <= 0) return std::pow(end, degree) / (degree * (end - start));
    if (end <= 0) return std::pow(start, degree) / (degree * (start - end));
    const double change = (end - start) / start;
    if (std::abs(change) < 1e-15) return std::pow(start, exponent);
    if (change > 1 || change < -0.5)
        return (std::pow(end, degree) - std::pow(start, degree)) / (degree * (end - start));
    return std::pow(start, exponent) * std::expm1(degree * std::log1p(change)) / (degree * change);
}

/// One compliant contact in one step.
struct CompliantMoment {
    double gap = 0;         ///< y at the step's start [m]
    double gap_before = 0;  ///< y one step earlier [m]
    double step_s = 0;      ///< h [s]
};

/// What each metre per second of approach adds to the force [kg/s]: K beta [-y]^p + R, at the middle of the
/// two steps that the force works over.
inline double drag(const Compliance& law, double gap) {
    const double loss = law.loss_s_per_m > 0 && gap < 0
                            ? law.stiffness * law.loss_s_per_m * std::pow(-gap, law.exponent)
                            : 0.0;
    return loss + law.resistance_kg_per_s;
}

/// Force [N] if the step ends with the gap `end`. It does not rise with `end`.
inline double compliant_force(const Compliance& law, const CompliantMoment& moment, double end) {
    const double depth_start = -(moment.gap + moment.gap_before) / 2;
    const double depth_end = -(end + moment.gap) / 2;
    const double elastic =
        law.stiffness > 0 ? law.stiffness * mean_power(depth_start, depth_end, law.exponent) : 0.0;
    return std::max(0.0, elastic + drag(law, moment.gap) * (depth_end - depth_start) / moment.step_s);
}

/// The impulse lambda >= 0 [N s] with lambda = h F(gap_free + compliance lambda). `compliance`: A_cc > 0.
double compliant_impulse(const Compliance& law, const CompliantMoment& moment, double gap_free,
                         double compliance);

}  // namespace jawari
