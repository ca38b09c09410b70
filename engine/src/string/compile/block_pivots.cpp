#include "string/compile/block_pivots.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace jawari {
namespace {

// Up to so many contacts nothing is solved first.
constexpr std::size_t fewest_contacts = 64;
// Of more, every fourth is.
constexpr std::size_t coarsening = 4;
// Blocks that are exchanged without fewer wrong signs than ever.
constexpr int most_vain_blocks = 3;
// Up to so many contacts single ones are exchanged then.
constexpr std::size_t few_contacts = 256;
constexpr int most_exchanges = 500;
// Of the worst violation: wrong signs up to this are rounding.
constexpr double largest_rounding = 1e-12;

struct Pivots {
    const ContactOperator& A;
    std::span<const double> r;
    std::vector<std::uint32_t> contacts;  ///< that take part
    std::vector<bool> active;             ///< for each of these, as the next
    Eigen::VectorXd lambda;
    Eigen::VectorXd residual;
    double tolerance = 0;

    [[nodiscard]] std::size_t count() const { return contacts.size(); }
    [[nodiscard]] double a(std::size_t i, std::size_t j) const { return A(contacts[i], contacts[j]); }
};

/// Impulses that close all active gaps, and the residuals of the others. False if active contacts depend on
/// one another.
bool close_active_gaps(Pivots& p) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < p.count(); ++i) {
        if (p.active[i]) rows.push_back(i);
    }
    const auto size = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd factor(size, size);
    Eigen::VectorXd solution(size);
    for (Eigen::Index column = 0; column < size; ++column) {
        const std::size_t j = rows[static_cast<std::size_t>(column)];
        solution(column) = -p.r[p.contacts[j]];
        for (Eigen::Index row = column; row < size; ++row)
            factor(row, column) = p.a(rows[static_cast<std::size_t>(row)], j);
    }
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> decomposition(factor);
    if (decomposition.info() != Eigen::Success) return false;
    decomposition.solveInPlace(solution);

    p.lambda.setZero();
    for (std::size_t k = 0; k < rows.size(); ++k)
        p.lambda(static_cast<Eigen::Index>(rows[k])) = solution(static_cast<Eigen::Index>(k));
    for (std::size_t i = 0; i < p.count(); ++i) {
        double sum = p.r[p.contacts[i]];
        for (const auto j : rows) sum += p.a(i, j) * p.lambda(static_cast<Eigen::Index>(j));
        p.residual(static_cast<Eigen::Index>(i)) = sum;
    }
    return true;
}

/// Contacts that pull, or that are violated without carrying.
std::vector<std::size_t> wrong_signs(const Pivots& p) {
    std::vector<std::size_t> wrong;
    for (std::size_t i = 0; i < p.count(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const double value = p.active[i] ? p.a(i, i) * p.lambda(row) : p.residual(row);
        if (value < -p.tolerance) wrong.push_back(i);
    }
    return wrong;
}

/// Exchanges contacts until all signs are right, of many until that no longer helps. False if contacts depend
/// on one another.
bool exchange(Pivots& p) {
    std::size_t fewest = p.count() + 1;
    int vain = 0;
    for (int exchanges = 0; exchanges < most_exchanges; ++exchanges) {
        if (!close_active_gaps(p)) return false;
        const std::vector<std::size_t> wrong = wrong_signs(p);
        vain = wrong.size() < fewest ? 0 : vain + 1;
        fewest = std::min(fewest, wrong.size());
        const bool singly = vain > most_vain_blocks;
        if (wrong.empty() || (singly && p.count() > few_contacts)) break;
        // The last one alone: Murty's rule of a fixed order, which ends.
        for (std::size_t k = singly ? wrong.size() - 1 : 0; k < wrong.size(); ++k)
            p.active[wrong[k]] = !p.active[wrong[k]];
    }
    return true;
}

/// The contacts that carry when every `coarsening`th is there alone, and those between them.
std::vector<bool> between(const Pivots& coarse, std::size_t count) {
    std::vector<bool> active(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t before = i / coarsening;
        const std::size_t after = std::min((i + coarsening - 1) / coarsening, coarse.count() - 1);
        active[i] = coarse.active[before] && coarse.active[after];
    }
    return active;
}

std::optional<Pivots> solve(const ContactOperator& A, std::span<const double> r,
                            std::vector<std::uint32_t> contacts, double tolerance) {
    std::vector<bool> active(contacts.size());
    if (contacts.size() <= fewest_contacts) {
        for (std::size_t i = 0; i < contacts.size(); ++i) active[i] = r[contacts[i]] < 0;
    } else {
        std::vector<std::uint32_t> some;
        for (std::size_t i = 0; i < contacts.size(); i += coarsening) some.push_back(contacts[i]);
        const auto coarse = solve(A, r, std::move(some), tolerance);
        if (!coarse) return {};
        active = between(*coarse, contacts.size());
    }
    const auto count = static_cast<Eigen::Index>(contacts.size());
    Pivots p{A,
             r,
             std::move(contacts),
             std::move(active),
             Eigen::VectorXd::Zero(count),
             Eigen::VectorXd::Zero(count),
             tolerance};
    if (!exchange(p)) return {};
    return p;
}

}  // namespace

std::vector<double> guess_by_block_pivots(const ContactOperator& A, std::span<const double> r) {
    std::vector<double> lambda(r.size(), 0.0);
    const double lowest = r.empty() ? 0.0 : *std::min_element(r.begin(), r.end());
    if (lowest >= 0) return lambda;
    std::vector<std::uint32_t> contacts(r.size());
    std::iota(contacts.begin(), contacts.end(), 0U);
    const auto solved = solve(A, r, std::move(contacts), -largest_rounding * lowest);
    if (!solved) return lambda;
    for (std::size_t c = 0; c < r.size(); ++c)
        lambda[c] = std::max(0.0, solved->lambda(static_cast<Eigen::Index>(c)));
    return lambda;
}

}  // namespace jawari
