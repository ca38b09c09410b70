#include "judge.h"

#include <algorithm>
#include <cmath>

namespace jawari::stress {

const char* name_of(Invariant invariant) {
    static constexpr std::array<const char*, invariant_count> names{
        "finite",   "energy_balance", "energy_rise", "penetration",
        "residual", "truncation",     "output",      "determinism"};
    return names[static_cast<std::size_t>(invariant)];
}

void Judge::at_most(Invariant invariant, double found, double allowed, const std::string& where) {
    double& closest = closest_[static_cast<std::size_t>(invariant)];
    if (found > 0 && allowed > 0 && std::isfinite(allowed)) closest = std::max(closest, found / allowed);
    if (found <= allowed) return;
    const bool known = std::any_of(violations_.begin(), violations_.end(),
                                   [&](const Violation& v) { return v.invariant == invariant; });
    if (!known) violations_.push_back({invariant, found, allowed, where});
}

}  // namespace jawari::stress
