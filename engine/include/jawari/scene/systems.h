// Mode tables of systems with closed forms that are no strings: bars and plates.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "jawari/scene/description.h"

namespace jawari {

/// How an end of a bar is held.
enum class BarEnd {
    Free,    ///< neither moment nor shear force
    Pinned,  ///< neither displacement nor moment
    Clamped  ///< neither displacement nor slope
};

/// Losses of a bar or a plate: none, or sigma = s_0 + s_1 f^2 through two points. T60 must not rise with
/// frequency.
using SystemLoss = std::variant<NoLoss, DecayTimePoints>;

/// A uniform bar in bending (Euler and Bernoulli).
struct Bar {
    double length_m = 0;                 ///< L, > 0 [m]
    double linear_density_kg_per_m = 0;  ///< mu, > 0 [kg/m]
    double bending_stiffness_N_m2 = 0;   ///< E I, > 0 [N m^2]
    std::array<BarEnd, 2> ends{};        ///< at x = 0 and x = L
    std::size_t count = 0;               ///< modes, 1 to limits::modes; those of frequency 0 come first
    SystemLoss damping;                  ///< modes of frequency 0 get s_0
};

/// A rectangular plate in bending (Kirchhoff), simply supported along its edges.
struct Plate {
    std::array<double, 2> size_m{};  ///< a and b, > 0 [m]
    double thickness_m = 0;          ///< > 0 [m]
    double density_kg_per_m3 = 0;    ///< rho, > 0 [kg/m^3]
    double youngs_modulus_Pa = 0;    ///< E, > 0 [Pa]
    double poissons_ratio = 0;       ///< nu, -1 to 0.5, ends excluded [1]
    std::size_t count = 0;           ///< modes, 1 to limits::modes, by frequency
    SystemLoss damping;              ///< of all modes
};

/// beta_k L of the bending modes that are not rigid, k from 1: the roots of the characteristic equation of
/// the ends, to rounding. Threads: any; realtime-safe.
double bar_root(std::array<BarEnd, 2> ends, std::size_t k);

/// Rigid motions that the ends leave: 2 of a free bar, 1 of one that is free and pinned, else 0. Threads:
/// any; realtime-safe.
std::size_t rigid_modes(std::array<BarEnd, 2> ends);

/// Frequencies (beta_k^2 sqrt(E I/mu)/(2 pi)) and losses. Threads: any. Allocates.
ModeTable bar_modes(const Bar& bar);

/// Shapes with the mean square 1 over the bar, so that every modal mass is mu L, at the places x, 0 to L [m].
/// Threads: any. Allocates.
ShapeTable bar_shapes(const Bar& bar, std::span<const double> places_m);

/// Frequencies pi/2 (m^2/a^2 + n^2/b^2) sqrt(D/(rho h)), D = E h^3/(12 (1 - nu^2)), and losses. Threads: any.
/// Allocates.
ModeTable plate_modes(const Plate& plate);

/// Shapes sin(m pi x/a) sin(n pi y/b) at the places (x, y), inside the plate [m]; every modal mass is a
/// quarter of the plate's. Threads: any. Allocates.
ShapeTable plate_shapes(const Plate& plate, std::span<const std::array<double, 2>> places_m);

}  // namespace jawari
