// Rivals that share the engine's modes and exact linear step and differ in the contact only: penalty
// (hunt_crossley.h) and energy quadratisation (quadratised_contact.h, the modal variant of JASA 2021).
#pragma once

#include "jawari/scene/description.h"
#include "quadratised_contact.h"
#include "trajectory.h"

namespace jawari::rivals {

struct ModalContactOptions {
    /// K h^2 D_max p_0^(alpha - 1), with D_max the largest Delassus diagonal and p_0 = 1 um: the contact's
    /// stiffness relative to the string's inertia at it over a step. Both methods are stable at any.
    double relative_stiffness = 1;
    double exponent = 1;
    /// Penalty only: speed at which the scene's restitution is met [m/s]. e below 0.05, which the law cannot
    /// reach, is met as 0.05.
    double restitution_speed = 1;
};

/// Every contact is evaluated at every step. Throws std::runtime_error if the scene does not compile.
benchmarks::Trajectory run_penalty(const SceneDescription& scene, double duration_s,
                                   const ModalContactOptions& options,
                                   const benchmarks::Repetition& repetition);

/// The same with one auxiliary variable per contact; restitution is ignored.
benchmarks::Trajectory run_quadratised_modal(const SceneDescription& scene, double duration_s,
                                             const ModalContactOptions& options,
                                             const benchmarks::Repetition& repetition);

}  // namespace jawari::rivals
