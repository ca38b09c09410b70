// Rival: a stiff, damped string by explicit finite differences (S. Bilbao, "Numerical Sound Synthesis", 2009,
// section 7.3) whose contacts are solved by energy quadratisation (quadratised_contact.h).
#pragma once

#include "jawari/scene/description.h"
#include "quadratised_contact.h"
#include "trajectory.h"

namespace jawari::rivals {

/// mu u_tt = T u_xx - E I u_xxxx - 2 s0 mu u_t + 2 s1 mu u_txx, pinned.
struct StiffString {
    double length_m = 0;
    double density_kg_per_m = 0;
    double wave_speed = 0;  ///< c [m/s]
    double stiffness = 0;   ///< kappa = sqrt(E I/mu) [m^2/s]
    double loss = 0;        ///< s0 [1/s]
    double loss_curve = 0;  ///< s1 [m^2/s]
};

/// The string whose modes are nearest to those described: c and kappa from tension and inharmonicity; s0 and
/// s1 by least squares, relative to each mode's loss, over the modes below 5 kHz. Needs modes from physics.
StiffString stiff_string(const StringDescription& string);

/// Smallest grid spacing at which the scheme is stable at time step k [m] (Bilbao 2009, eq. 7.30 with loss).
double smallest_spacing(const StiffString& string, double k);

struct QuadratisedOptions {
    /// K k^2/(mu dx) p_0^(alpha - 1), p_0 = 1 um: the contact's stiffness relative to a grid point's inertia.
    /// The scheme is stable at any.
    double relative_stiffness = 1;
    double exponent = 1;
    Auxiliary auxiliary = Auxiliary::PerContact;
};

/// Steps at the scene's contact rate on the finest grid that is stable. Contacts conserve energy: restitution
/// is ignored. Every contact is evaluated at every step. Throws std::runtime_error for modes from tables.
benchmarks::Trajectory run_quadratised(const SceneDescription& scene, double duration_s,
                                       const QuadratisedOptions& options,
                                       const benchmarks::Repetition& repetition);

}  // namespace jawari::rivals
