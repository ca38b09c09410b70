#include "string/compile/static_equilibrium.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "jawari/detail/lcp.h"
#include "string/compile/block_pivots.h"
#include "string/compile/contact_tables.h"
#include "string/compile/places.h"
#include "string/kernels/mode_sums.h"
#include "string/model/compliant_law.h"
#include "string/model/contact_response.h"

namespace jawari {
namespace {

/// The gap of contacts that do not take part.
constexpr double out_of_reach_m = 1e100;

bool gives_way(const StringShape& shape, std::size_t c) {
    return !shape.contact_compliance.empty() && !is_rigid(shape.contact_compliance[c]);
}

std::optional<std::vector<double>> forces(const ContactOperator& A, std::span<const double> gap) {
    const std::size_t count = gap.size();
    std::vector<std::uint32_t> candidates(count);
    std::iota(candidates.begin(), candidates.end(), 0U);
    std::vector<double> force(count, 0.0);
    if (count > largest_factor) force = guess_by_block_pivots(A, gap);
    std::vector<double> residual(count, 0.0);
    LcpWorkspace workspace = make_lcp_workspace(count, {count, count, 0});
    if (!solve_lcp(A, gap, candidates, force, residual, workspace).finished) return {};
    return force;
}

}  // namespace

std::optional<AlignedVector<double>> held_displacement(const StringModel& model,
                                                       std::span<const double> displacement) {
    const std::size_t n = model.shape->stride;
    const std::size_t count = model.shape->contact_count;
    AlignedVector<double> held(n, 0.0);
    AlignedVector<double> gap(model.shape->contact_stride, 0.0);
    kernels::row_products(count, n, n, model.shape->contact_rows.data(), displacement.data(), gap.data());
    bool penetrates = false;
    for (std::size_t c = 0; c < count; ++c) {
        gap[c] -= model.shape->contact_height[c];
        if (gives_way(*model.shape, c)) gap[c] = out_of_reach_m;
        penetrates = penetrates || gap[c] < 0;
    }
    if (!penetrates) return held;

    AlignedVector<double> compliance_of_mode(n, 0.0);  // 1/(mu omega^2)
    for (std::size_t k = 0; k < own_mode_count(*model.shape); ++k) {
        if (model.tuning.potential[k] == 0) return {};
        compliance_of_mode[k] = 0.5 / model.tuning.potential[k];
    }
    const AlignedVector<double> values = contact_operator(*model.shape, 1.0, compliance_of_mode);
    ContactOperator static_compliance = compliance_of(model);
    static_compliance.values = values.data();
    static_compliance.id = 0;
    static_compliance.norm = 0;
    const auto force = forces(static_compliance, std::span<const double>(gap).first(count));
    if (!force) return {};
    for (std::size_t c = 0; c < count; ++c) {
        if ((*force)[c] > 0) {
            kernels::add_impulse(n, (*force)[c], compliance_of_mode.data(),
                                 model.shape->contact_rows.data() + c * n, held.data());
        }
    }
    return held;
}

}  // namespace jawari
