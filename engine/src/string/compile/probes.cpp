#include "string/compile/probes.h"

#include <numbers>

#include "base/square.h"
#include "jawari/scene/modes.h"
#include "string/compile/places.h"

namespace jawari {
namespace {

/// What the string presses on its support with, per unit of each coordinate: mu omega^2 times the integral of
/// phi_k(x) times the distance from the other end over L, which is sqrt(2/L) L/(k pi) at x = 0.
void write_support_force(const StringShape& shape, const StringTuning& tuning, bool at_bridge, double* row) {
    for (std::size_t k = 0; k < own_mode_count(shape); ++k) {
        const double wavenumber = static_cast<double>(k + 1) * std::numbers::pi / shape.length_m;
        // phi_k'(0)/wavenumber^2; at x = L the force is minus the slope's.
        const double place = at_bridge ? shape.length_m : 0.0;
        const double reach = mode_slope(k + 1, place, shape.length_m) / square(wavenumber);
        row[k] = (at_bridge ? -1 : 1) * shape.linear_density_kg_per_m * square(tuning.omega[k]) * reach;
    }
}

void write_row(const StringDraft& draft, const StringDescription& string, const ProbeDescription& probe,
               double* row) {
    const StringShape& shape = *draft.shape;
    switch (probe.quantity) {
        case Quantity::Displacement:
        case Quantity::Velocity:
        case Quantity::Acceleration:
            write_shape(shape, string, probe.position_m, probe.point, 1.0, row);
            break;
        case Quantity::Slope:
            for (std::size_t k = 0; k < own_mode_count(shape); ++k)
                row[k] = mode_slope(k + 1, probe.position_m, shape.length_m);
            break;
        case Quantity::NutForce:
        case Quantity::BridgeForce:
            write_support_force(shape, draft.model.tuning, probe.quantity == Quantity::BridgeForce, row);
            break;
        case Quantity::ModeDisplacement:
        case Quantity::ModeVelocity:
            row[probe.mode - 1] = shape.coordinate_unit[probe.mode - 1];
            break;
        case Quantity::HammerDisplacement:
            row[hammer_mode(shape, probe.hammer)] = hammer_unit(shape, string.hammers[probe.hammer]);
            break;
        case Quantity::ModeEnergy:
        case Quantity::ContactForce:
        case Quantity::HammerForce:
        case Quantity::Energy:
            break;
    }
}

}  // namespace

void set_probes(StringDraft& draft, const StringDescription& string) {
    StringShape& shape = *draft.shape;
    shape.probes = string.probes;
    shape.probe_rows.assign(string.probes.size() * shape.stride, 0.0);
    for (std::size_t p = 0; p < string.probes.size(); ++p)
        write_row(draft, string, string.probes[p], shape.probe_rows.data() + p * shape.stride);
}

}  // namespace jawari
