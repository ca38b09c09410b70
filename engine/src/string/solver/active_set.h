// The active set of a complementarity problem and the Cholesky factor of its part of the operator.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "jawari/detail/lcp.h"

namespace jawari {

/// A complementarity problem and its workspace.
struct ActiveSetProblem {
    const ContactOperator& A;
    std::span<const double> r;
    std::span<const std::uint32_t> candidates;
    std::span<double> lambda;
    std::span<double> residual;
    LcpWorkspace& work;
    double tolerance = 0;  ///< violations below it are rounding

    [[nodiscard]] double a(std::size_t i, std::size_t j) const { return A(i, j); }
};

/// direction <- column of A at the active contacts, row `contact`.
void gather_column(const ActiveSetProblem& p, std::size_t contact, AlignedVector<double>& column);

/// Appends a contact to the active set and a row to the factor; false if it depends on the active ones or
/// there is no room, which LcpWorkspace::full then says.
bool append_active(const ActiveSetProblem& p, std::size_t contact);

/// Keeps the first `kept` active contacts and refactors those that follow in work.active up to `count`.
void refactor_from(const ActiveSetProblem& p, std::size_t kept, std::size_t count);

/// Removes the contact at a position of the active set.
void remove_active(const ActiveSetProblem& p, std::size_t position);

/// Removes the contacts whose solution is not positive, their impulses become zero. Returns whether there are
/// any.
bool thin_active(const ActiveSetProblem& p);

/// The active set becomes the candidates with a positive impulse; the factor's rows that agree stay.
void adopt_active_set(const ActiveSetProblem& p);

/// storage <- A_FF^{-1} storage over the active contacts.
void solve_with_factor(const ActiveSetProblem& p, AlignedVector<double>& storage);

/// solution <- -A_FF^{-1} r_F
void solve_active(const ActiveSetProblem& p);

/// The same; when a small active set has lasted, its inverse is made, and from then on it serves.
void solve_kept_set(const ActiveSetProblem& p);

/// Whether the active set has lasted so long that its inverse serves.
bool uses_inverse(const ActiveSetProblem& p);

bool is_active(const LcpWorkspace& work, std::size_t contact);

}  // namespace jawari
