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
        case Quantity::ContactForce:
            return "contact_force";
        case Quantity::Energy:
            return "energy";
    }
    return {};
}

std::string unit(Quantity quantity) {
    switch (quantity) {
        case Quantity::Displacement:
            return "m";
        case Quantity::Velocity:
            return "m/s";
        case Quantity::ContactForce:
            return "N";
        case Quantity::Energy:
            return "J";
    }
    return {};
}

}  // namespace jawari::host
