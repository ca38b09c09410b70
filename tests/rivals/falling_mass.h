// A free mass that flies into a barrier: what the rivals' papers show first.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace jawari::test {

struct Collision {
    double deepest = 0;        ///< largest penetration [m]
    double leaving_speed = 0;  ///< [m/s]
    double worst_energy = 0;   ///< largest relative change of kinetic + stored energy
};

/// `stored(contacts)`: energy in the contact half a step ago. The mass starts 10 steps before the barrier.
template <class Contacts, class Stored>
Collision collide(Contacts contacts, double mass, double speed, double h, std::size_t steps,
                  Stored&& stored) {
    std::array<double, 1> now{-9.5 * h * speed}, before{-10.5 * h * speed}, free{}, force{};
    const std::array<double, 1> M{h * h / mass};
    contacts.start(now);
    Collision result;
    const double initial = mass * speed * speed / 2;
    for (std::size_t n = 0; n < steps; ++n) {
        free[0] = 2 * now[0] - before[0];
        contacts.solve(now, before, free, M, force);
        before = now;
        now[0] = free[0] - M[0] * force[0];
        result.deepest = std::max(result.deepest, now[0]);
        const double v = (now[0] - before[0]) / h;
        result.worst_energy =
            std::max(result.worst_energy, std::abs((mass * v * v / 2 + stored(contacts)) / initial - 1));
        result.leaving_speed = -v;
        if (now[0] < -20 * h * speed) break;
    }
    return result;
}

}  // namespace jawari::test
