#include "jawari/parameters.h"

#include <algorithm>
#include <cmath>

namespace jawari {

double parameter_value(const ParameterDeclaration& parameter, double travel) noexcept {
    const double t = std::clamp(travel, 0.0, 1.0);
    const double span = parameter.high - parameter.low;
    switch (parameter.curve) {
        case Curve::Linear:
            break;
        case Curve::Exponential:
            return parameter.low * std::pow(parameter.high / parameter.low, t);
        case Curve::Squared:
            return parameter.low + t * t * span;
        case Curve::Stepped:
            return std::round(parameter.low + t * span);
    }
    return parameter.low + t * span;
}

double parameter_travel(const ParameterDeclaration& parameter, double value) noexcept {
    const double inside = std::clamp(value, parameter.low, parameter.high);
    const double share = (inside - parameter.low) / (parameter.high - parameter.low);
    switch (parameter.curve) {
        case Curve::Linear:
        case Curve::Stepped:
            break;
        case Curve::Exponential:
            return std::log(inside / parameter.low) / std::log(parameter.high / parameter.low);
        case Curve::Squared:
            return std::sqrt(share);
    }
    return share;
}

}  // namespace jawari
