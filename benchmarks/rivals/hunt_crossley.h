// Rival: contact by penalty with damping (K. H. Hunt and F. R. E. Crossley, "Coefficient of restitution
// interpreted as damping in vibroimpact", J. Appl. Mech. 42, 1975), stepped conservatively and solved by
// Newton's method as in C. Issanchou, S. Bilbao, J.-L. Le Carrou, C. Touze, O. Doare, JSV 393 (2017).
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "quadratised_contact.h"

namespace jawari::rivals {

/// Restitution of a free mass against the force K p^alpha (1 + d p') at approach speed v, whatever mass,
/// stiffness and exponent. With x = d v it is the root e of x - ln(1 + x) = -e x - ln(1 - e x): m p' dp'/dp =
/// -f, separated and integrated.
double restitution_of_damping(double damping_s_per_m, double speed_m_per_s);

/// The d for which a mass that arrives at `speed_m_per_s` leaves with e times that; the inverse of the above.
/// e > 0.
double damping_of_restitution(double restitution, double speed_m_per_s);

/// Contacts of a system stepped by p(n+1) = p_free - M f, M symmetric, with
///     f = (E(p(n+1)) - E(p(n-1)))/(p(n+1) - p(n-1)) + d K p(n)^alpha (p(n+1) - p(n-1))/(2 h).
class HuntCrossleyContacts {
  public:
    HuntCrossleyContacts(PowerLaw law, std::vector<double> damping_s_per_m, double step_s);

    void start(std::span<const double> /*penetration*/) {}

    /// As QuadratisedContacts::solve.
    void solve(std::span<const double> now, std::span<const double> before, std::span<const double> free,
               std::span<const double> M, std::span<double> force);

    /// Newton iterations and solves so far; solves that had not converged after the largest number of
    /// iterations.
    std::uint64_t iterations = 0, solves = 0, failures = 0;

  private:
    /// Elastic force over p(n-1)..p(n-1)+r, and its derivative with respect to r.
    [[nodiscard]] std::pair<double, double> elastic(double before, double r) const;

    PowerLaw law_;
    std::vector<double> damping_;
    double step_s_;
    std::vector<std::size_t> active_;
};

}  // namespace jawari::rivals
