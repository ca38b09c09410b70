#include "string/compile/static_equilibrium.h"

#include <algorithm>
#include <numeric>

#include "jawari/detail/lcp.h"
#include "string/compile/contact_tables.h"
#include "string/kernels/mode_sums.h"
#include "string/model/contact_response.h"

namespace jawari {

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
        penetrates = penetrates || gap[c] < 0;
    }
    if (!penetrates) return held;

    AlignedVector<double> compliance_of_mode(n, 0.0);  // 1/(mu omega^2)
    for (std::size_t k = 0; k < model.shape->mode_count; ++k)
        compliance_of_mode[k] = 0.5 / model.tuning.potential[k];
    const AlignedVector<double> values = contact_operator(*model.shape, 1.0, compliance_of_mode);
    ContactOperator static_compliance = compliance_of(model);
    static_compliance.values = values.data();
    static_compliance.id = 0;
    static_compliance.norm = 0;
    std::vector<std::uint32_t> candidates(count);
    std::iota(candidates.begin(), candidates.end(), 0U);
    AlignedVector<double> force(model.shape->contact_stride, 0.0);
    AlignedVector<double> residual(model.shape->contact_stride, 0.0);
    LcpWorkspace workspace = make_lcp_workspace(count, {count, count, 0});
    const LcpOutcome outcome = solve_lcp(static_compliance, gap, candidates, force, residual, workspace);
    if (!outcome.finished) return {};
    for (std::size_t c = 0; c < count; ++c) {
        if (force[c] > 0) {
            kernels::add_impulse(n, force[c], compliance_of_mode.data(),
                                 model.shape->contact_rows.data() + c * n, held.data());
        }
    }
    return held;
}

}  // namespace jawari
