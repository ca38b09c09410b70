#include "formats/scene/words.h"

namespace jawari::host {

std::string word(Scheme scheme) {
    return scheme == Scheme::Exact ? "exact" : "theta";
}

std::string word(ImpactLaw law) {
    return name_of(law);
}

std::string word(Start start) {
    return start == Start::Exact ? "exact" : "backward";
}

std::string word(Side side) {
    return side == Side::Below ? "below" : "above";
}

std::string word(Quantity quantity) {
    switch (quantity) {
        case Quantity::Displacement:
            return "displacement";
        case Quantity::Velocity:
            return "velocity";
        case Quantity::Acceleration:
            return "acceleration";
        case Quantity::Slope:
            return "slope";
        case Quantity::NutForce:
            return "nut_force";
        case Quantity::BridgeForce:
            return "bridge_force";
        case Quantity::ModeDisplacement:
            return "mode_displacement";
        case Quantity::ModeVelocity:
            return "mode_velocity";
        case Quantity::ModeEnergy:
            return "mode_energy";
        case Quantity::ContactForce:
            return "contact_force";
        case Quantity::HammerForce:
            return "hammer_force";
        case Quantity::HammerDisplacement:
            return "hammer_displacement";
        case Quantity::Energy:
            return "energy";
    }
    return {};
}

std::string unit(Quantity quantity, bool tabled_shapes) {
    switch (quantity) {
        case Quantity::Displacement:
        case Quantity::HammerDisplacement:
            return "m";
        case Quantity::Velocity:
            return "m/s";
        case Quantity::Acceleration:
            return "m/s^2";
        case Quantity::Slope:
            return "1";
        case Quantity::ModeDisplacement:
            return tabled_shapes ? "m" : "m^1.5";
        case Quantity::ModeVelocity:
            return tabled_shapes ? "m/s" : "m^1.5/s";
        case Quantity::NutForce:
        case Quantity::BridgeForce:
        case Quantity::ContactForce:
        case Quantity::HammerForce:
            return "N";
        case Quantity::ModeEnergy:
        case Quantity::Energy:
            return "J";
    }
    return {};
}

}  // namespace jawari::host
