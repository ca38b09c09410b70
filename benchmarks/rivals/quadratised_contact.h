// Rival: contact by energy quadratisation, solved without iteration.
//     M. Ducceschi, S. Bilbao, S. Willemsen, S. Serafin, "Linearly-implicit schemes for collisions in musical
//     acoustics based on energy quadratisation", JASA 149 (2021): one auxiliary variable per contact (IEQ);
//     S. Bilbao, M. Ducceschi, F. Zama, "Explicit exactly energy-conserving methods for Hamiltonian systems",
//     J. Comput. Phys. 472 (2023): one auxiliary variable for all (SAV).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace jawari::rivals {

/// Contact potential K/(alpha+1) p^(alpha+1) of the penetration p > 0.
struct PowerLaw {
    double stiffness = 0;  ///< K [N/m^alpha]
    double exponent = 1;   ///< alpha >= 1

    [[nodiscard]] double energy(double p) const;  ///< [J]
    [[nodiscard]] double force(double p) const;   ///< [N]
    /// d psi/dp of psi = sqrt(2 energy), for p >= 0.
    [[nodiscard]] double slope(double p) const;
};

enum class Auxiliary {
    PerContact,  ///< IEQ
    Shared       ///< SAV
};

/// Contacts of a system stepped by p(n+1) = p_free - M f, with f the contact forces and M symmetric.
class QuadratisedContacts {
  public:
    QuadratisedContacts(PowerLaw law, std::size_t contacts, Auxiliary auxiliary);

    void start(std::span<const double> penetration);

    /// Forces [N] of one step: penetrations now, one step before, and one step later without forces; M by
    /// rows.
    void solve(std::span<const double> now, std::span<const double> before, std::span<const double> free,
               std::span<const double> M, std::span<double> force);

    /// Energy stored in the contacts, half a step ago [J].
    [[nodiscard]] double energy() const;

  private:
    void solve_per_contact(std::span<const double> now, std::span<const double> before,
                           std::span<const double> free, std::span<const double> M, std::span<double> force);
    void solve_shared(std::span<const double> now, std::span<const double> before,
                      std::span<const double> free, std::span<const double> M, std::span<double> force);

    PowerLaw law_;
    Auxiliary auxiliary_;
    std::vector<double> psi_;  ///< auxiliary variables, half a step ago [sqrt(J)]
    std::vector<double> g_;    ///< their slopes at the step
    std::vector<std::size_t> active_;
    std::vector<double> matrix_, right_;
};

}  // namespace jawari::rivals
