// Obstacles with a shape, as lists of point contacts.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "jawari/scene/description.h"

namespace jawari {

/// Distance [m] of a fret from the nut at equal temperament: L (1 - 2^(-fret/12)).
double equal_temperament_position(double length_m, std::size_t fret);

/// Frets 1..heights.size() at equal temperament, each at its own height [m], pressing from below.
std::vector<ContactDescription> equal_temperament_frets(double length_m, std::span<const double> heights_m,
                                                        double restitution);

/// One corner of a neck profile: (position [m], height [m]).
using ProfilePoint = std::pair<double, double>;

/// A neck sampled at the interior points x_j = j L/(n+1), j = 1..n, linear between the profile's points and
/// constant outside them. Precondition: profile not empty, positions not decreasing.
std::vector<ContactDescription> sampled_neck(double length_m, std::size_t grid_points,
                                             std::span<const ProfilePoint> profile, double restitution);

}  // namespace jawari
