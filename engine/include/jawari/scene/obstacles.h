// Obstacles with a shape, as lists of point contacts.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "jawari/scene/description.h"

namespace jawari {

/// Distance of a fret from the nut at equal temperament: L (1 - 2^(-fret/12)) [m]. `length_m`: L, nut to
/// bridge [m]; `fret`: 0 is the nut. Threads: any; realtime-safe.
double equal_temperament_position(double length_m, std::size_t fret);

/// Frets 1 to heights_m.size() at equal temperament, pressing from below. `heights_m`: of each fret's top
/// from the rest line [m], negative below it; `restitution`: 0 to 1. Threads: any. Allocates.
std::vector<ContactDescription> equal_temperament_frets(double length_m, std::span<const double> heights_m,
                                                        double restitution);

/// One corner of a neck profile: (position [m], height [m]).
using ProfilePoint = std::pair<double, double>;

/// A neck sampled at the n = `grid_points` interior points x_j = j L/(n+1), linear between the profile's
/// points and constant outside them. `restitution`: 0 to 1. Precondition: `profile` is not empty, its
/// positions do not decrease. Threads: any. Allocates.
std::vector<ContactDescription> sampled_neck(double length_m, std::size_t grid_points,
                                             std::span<const ProfilePoint> profile, double restitution);

}  // namespace jawari
