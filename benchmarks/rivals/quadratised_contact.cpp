#include "quadratised_contact.h"

#include <algorithm>
#include <cmath>

namespace jawari::rivals {
namespace {

/// Keeps the square root's argument positive (SAV); far below the energies of any scene here.
constexpr double energy_floor_J = 1e-20;

/// Solves the dense n x n system in place by elimination; its matrix is the identity plus a product of
/// positive semidefinite ones, for which no pivoting is needed.
void eliminate(std::size_t n, std::vector<double>& a, std::vector<double>& b) {
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t r = i + 1; r < n; ++r) {
            const double factor = a[r * n + i] / a[i * n + i];
            if (factor == 0) continue;
            for (std::size_t c = i; c < n; ++c) a[r * n + c] -= factor * a[i * n + c];
            b[r] -= factor * b[i];
        }
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t c = i + 1; c < n; ++c) b[i] -= a[i * n + c] * b[c];
        b[i] /= a[i * n + i];
    }
}

}  // namespace

double PowerLaw::energy(double p) const {
    return p > 0 ? stiffness / (exponent + 1) * std::pow(p, exponent + 1) : 0;
}

double PowerLaw::force(double p) const {
    return p > 0 ? stiffness * std::pow(p, exponent) : 0;
}

double PowerLaw::slope(double p) const {
    const double root = std::sqrt(stiffness * (exponent + 1) / 2);
    return exponent == 1 ? root : root * std::pow(p, (exponent - 1) / 2);
}

QuadratisedContacts::QuadratisedContacts(PowerLaw law, std::size_t contacts, Auxiliary auxiliary)
    : law_(law),
      auxiliary_(auxiliary),
      psi_(auxiliary == Auxiliary::Shared ? 1 : contacts),
      g_(contacts),
      matrix_(contacts * contacts),
      right_(contacts) {
    active_.reserve(contacts);
}

void QuadratisedContacts::start(std::span<const double> penetration) {
    if (auxiliary_ == Auxiliary::PerContact) {
        for (std::size_t c = 0; c < g_.size(); ++c) psi_[c] = std::sqrt(2 * law_.energy(penetration[c]));
        return;
    }
    double total = energy_floor_J;
    for (const double p : penetration) total += 2 * law_.energy(p);
    psi_[0] = std::sqrt(total);
}

double QuadratisedContacts::energy() const {
    double sum = 0;
    for (const double psi : psi_) sum += psi * psi / 2;
    return sum;
}

void QuadratisedContacts::solve(std::span<const double> now, std::span<const double> before,
                                std::span<const double> free, std::span<const double> M,
                                std::span<double> force) {
    if (auxiliary_ == Auxiliary::PerContact) {
        solve_per_contact(now, before, free, M, force);
    } else {
        solve_shared(now, before, free, M, force);
    }
}

// f_c = g_c (psi+ + psi-)/2,   psi+ - psi- = g_c (p(n+1) - p(n-1))/2,   p(n+1) = p_free - M f:
//     (I + diag(g^2/4) M) f = g psi- + g^2/4 (p_free - p(n-1))
void QuadratisedContacts::solve_per_contact(std::span<const double> now, std::span<const double> before,
                                            std::span<const double> free, std::span<const double> M,
                                            std::span<double> force) {
    const std::size_t contacts = g_.size();
    active_.clear();
    for (std::size_t c = 0; c < contacts; ++c) {
        const double drift = free[c] - before[c];
        if (now[c] >= 0) {
            g_[c] = (psi_[c] >= 0 ? 1 : -1) * law_.slope(now[c]);
        } else if (psi_[c] != 0 && drift != 0) {
            g_[c] = -2 * psi_[c] /
                    drift;  // brings psi to zero out of contact (JASA 2021, its section on the sign of psi)
        } else {
            g_[c] = 0;
        }
        force[c] = 0;
        if (g_[c] != 0) active_.push_back(c);
    }
    const std::size_t n = active_.size();
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t c = active_[i];
        const double quarter = g_[c] * g_[c] / 4;
        for (std::size_t j = 0; j < n; ++j) matrix_[i * n + j] = quarter * M[c * contacts + active_[j]];
        matrix_[i * n + i] += 1;
        right_[i] = g_[c] * psi_[c] + quarter * (free[c] - before[c]);
    }
    eliminate(n, matrix_, right_);
    for (std::size_t i = 0; i < n; ++i) force[active_[i]] = right_[i];
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t c = active_[i];
        double next = free[c];
        for (std::size_t j = 0; j < n; ++j) next -= M[c * contacts + active_[j]] * right_[j];
        psi_[c] += g_[c] * (next - before[c]) / 2;
        if (now[c] < 0) psi_[c] = 0;
    }
}

// The same with one psi: f = G s, G = f(p)/sqrt(2 E), s (1 + G'MG/4) = psi- + G'(p_free - p(n-1))/4.
void QuadratisedContacts::solve_shared(std::span<const double> now, std::span<const double> before,
                                       std::span<const double> free, std::span<const double> M,
                                       std::span<double> force) {
    const std::size_t contacts = g_.size();
    active_.clear();
    double twice_energy = energy_floor_J;
    for (std::size_t c = 0; c < contacts; ++c) {
        force[c] = 0;
        if (now[c] <= 0) continue;
        active_.push_back(c);
        g_[c] = law_.force(now[c]);
        twice_energy += 2 * law_.energy(now[c]);
    }
    if (active_.empty()) {
        psi_[0] = std::sqrt(energy_floor_J);  // out of contact nothing is stored
        return;
    }
    double drift = 0, square = 0;
    for (const std::size_t c : active_) {
        g_[c] /= std::sqrt(twice_energy);
        drift += g_[c] * (free[c] - before[c]);
    }
    for (const std::size_t c : active_) {
        for (const std::size_t d : active_) square += g_[c] * M[c * contacts + d] * g_[d];
    }
    const double s = (psi_[0] + drift / 4) / (1 + square / 4);
    for (const std::size_t c : active_) force[c] = g_[c] * s;
    psi_[0] = 2 * s - psi_[0];
}

}  // namespace jawari::rivals
