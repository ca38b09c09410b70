#include "string/solver/active_set.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace jawari {
namespace {

// Solves in a row with the same active set, after which its inverse is worth making.
constexpr std::size_t lasting = 8;
// A large active set is factored anew where more than one contact in so many leaves it.
constexpr std::size_t few = 8;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Factor = Eigen::Map<Matrix, Eigen::Aligned, Eigen::OuterStride<>>;
using Vector = Eigen::Map<Eigen::VectorXd>;
using Inverse = Eigen::Map<Matrix, Eigen::Aligned, Eigen::OuterStride<largest_inverse>>;

Factor factor_of(LcpWorkspace& work) {
    const auto n = static_cast<Eigen::Index>(work.active_count);
    return {work.factor.data(), n, n, Eigen::OuterStride<>(static_cast<Eigen::Index>(work.room))};
}

Vector vector_of(const LcpWorkspace& work, AlignedVector<double>& storage) {
    return {storage.data(), static_cast<Eigen::Index>(work.active_count)};
}

double* row_of(LcpWorkspace& work, std::size_t i) {
    return work.factor.data() + i * work.room;
}

Inverse inverse_of_active(LcpWorkspace& work) {
    const auto n = static_cast<Eigen::Index>(work.active_count);
    return {work.inverse.data(), n, n};
}

/// Removes a row of the factor by plane rotations, which take the column that it leaves too many out of the
/// rows below (Golub and Van Loan, "Matrix Computations", 2013, section 6.5.4): O(n^2) operations.
/// work.solution and work.direction hold the rotations meanwhile.
void rotate_row_out(LcpWorkspace& work, std::size_t position) {
    double* cosine = work.solution.data();
    double* sine = work.direction.data();
    for (std::size_t i = position; i + 1 < work.active_count; ++i) {
        double* row = row_of(work, i);
        std::copy_n(row_of(work, i + 1), i + 2, row);
        double carried = row[position];
        for (std::size_t j = position; j < i; ++j) {
            const double next = row[j + 1];
            row[j] = cosine[j] * carried + sine[j] * next;
            carried = cosine[j] * next - sine[j] * carried;
        }
        const double length = std::hypot(carried, row[i + 1]);
        cosine[i] = carried / length;
        sine[i] = row[i + 1] / length;
        row[i] = length;
    }
}

}  // namespace

void gather_column(const ActiveSetProblem& p, std::size_t contact, AlignedVector<double>& column) {
    for (std::size_t i = 0; i < p.work.active_count; ++i) column[i] = p.a(contact, p.work.active[i]);
}

bool append_active(const ActiveSetProblem& p, std::size_t contact) {
    LcpWorkspace& work = p.work;
    work.repeated = 0;
    if (work.active_count == work.capacity) {
        work.full = true;
        return false;
    }
    gather_column(p, contact, work.direction);
    auto row = vector_of(work, work.direction);
    factor_of(work).triangularView<Eigen::Lower>().solveInPlace(row);
    const double pivot = p.a(contact, contact) - row.squaredNorm();
    if (!(pivot > factor_tolerances.dependent_pivot * p.a(contact, contact))) return false;
    double* factor_row = row_of(work, work.active_count);
    std::copy_n(work.direction.data(), work.active_count, factor_row);
    factor_row[work.active_count] = std::sqrt(pivot);
    work.active[work.active_count++] = static_cast<std::uint32_t>(contact);
    return true;
}

void refactor_from(const ActiveSetProblem& p, std::size_t kept, std::size_t count) {
    p.work.active_count = kept;
    p.work.repeated = 0;
    for (std::size_t i = kept; i < count; ++i) {
        const auto contact = p.work.active[i];  // read before append_active writes at or before i
        if (!append_active(p, contact)) p.lambda[contact] = 0;
    }
}

void remove_active(const ActiveSetProblem& p, std::size_t position) {
    LcpWorkspace& work = p.work;
    work.repeated = 0;
    const bool rotates = work.active_count > largest_factor;
    if (rotates) rotate_row_out(work, position);
    const std::size_t count = work.active_count - 1;
    std::copy(work.active.begin() + static_cast<std::ptrdiff_t>(position) + 1,
              work.active.begin() + static_cast<std::ptrdiff_t>(work.active_count),
              work.active.begin() + static_cast<std::ptrdiff_t>(position));
    if (rotates) {
        work.active_count = count;
    } else {
        refactor_from(p, position, count);
    }
}

bool thin_active(const ActiveSetProblem& p) {
    LcpWorkspace& work = p.work;
    const std::size_t before = work.active_count;
    std::size_t leaving = 0;
    for (std::size_t i = 0; i < before; ++i) {
        if (work.solution[i] > 0) continue;
        p.lambda[work.active[i]] = 0;
        leaving += 1;
    }
    if (leaving == 0) return false;
    if (before > largest_factor && leaving * few < before) {
        for (std::size_t i = before; i-- > 0;) {
            if (p.lambda[work.active[i]] <= 0) remove_active(p, i);
        }
        return true;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < before; ++i) {
        if (work.solution[i] > 0) work.active[kept++] = work.active[i];
    }
    refactor_from(p, 0, kept);
    return true;
}

bool is_active(const LcpWorkspace& work, std::size_t contact) {
    const auto end = work.active.begin() + static_cast<std::ptrdiff_t>(work.active_count);
    return std::find(work.active.begin(), end, contact) != end;
}

namespace {

/// What differs leaves and enters a large factor; the order of its rows does not matter.
void exchange_active(const ActiveSetProblem& p) {
    for (std::size_t i = p.work.active_count; i-- > 0;) {
        if (p.lambda[p.work.active[i]] <= 0) remove_active(p, i);
    }
    for (const auto c : p.candidates) {
        if (p.lambda[c] > 0 && !is_active(p.work, c) && !append_active(p, c)) p.lambda[c] = 0;
    }
}

}  // namespace

void adopt_active_set(const ActiveSetProblem& p) {
    LcpWorkspace& work = p.work;
    if (work.active_count > largest_factor) {
        exchange_active(p);
        return;
    }
    std::size_t agreed = 0;
    bool agrees = true;
    for (const auto c : p.candidates) {
        if (p.lambda[c] <= 0) continue;
        agrees = agrees && agreed < work.active_count && work.active[agreed] == c;
        if (agrees) {
            agreed += 1;
            continue;
        }
        work.active_count = agreed;
        if (!append_active(p, c)) p.lambda[c] = 0;
        agreed = work.active_count;
    }
    if (agreed < work.active_count) work.repeated = 0;
    work.active_count = agreed;
}

void solve_with_factor(const ActiveSetProblem& p, AlignedVector<double>& storage) {
    auto x = vector_of(p.work, storage);
    const auto lower = factor_of(p.work);
    lower.triangularView<Eigen::Lower>().solveInPlace(x);
    lower.transpose().triangularView<Eigen::Upper>().solveInPlace(x);
}

void solve_active(const ActiveSetProblem& p) {
    for (std::size_t i = 0; i < p.work.active_count; ++i) p.work.solution[i] = -p.r[p.work.active[i]];
    solve_with_factor(p, p.work.solution);
}

bool uses_inverse(const ActiveSetProblem& p) {
    return p.work.repeated >= lasting;
}

void solve_kept_set(const ActiveSetProblem& p) {
    LcpWorkspace& work = p.work;
    work.repeated += 1;
    if (work.repeated < lasting || work.active_count > largest_inverse) {
        solve_active(p);
        return;
    }
    Inverse inverse = inverse_of_active(work);
    if (work.repeated == lasting) {
        inverse.setIdentity();
        factor_of(work).triangularView<Eigen::Lower>().solveInPlace(inverse);
        factor_of(work).transpose().triangularView<Eigen::Upper>().solveInPlace(inverse);
    }
    for (std::size_t i = 0; i < work.active_count; ++i) work.direction[i] = -p.r[work.active[i]];
    for (std::size_t i = 0; i < work.active_count; ++i) {
        const double* row = work.inverse.data() + i * largest_inverse;
        double sum = 0;
        for (std::size_t j = 0; j < work.active_count; ++j) sum += row[j] * work.direction[j];
        work.solution[i] = sum;
    }
}

}  // namespace jawari
