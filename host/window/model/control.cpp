#include "window/model/control.h"

#include <algorithm>

namespace jawari::host::window {

ControlDrag::ControlDrag(const ParameterDeclaration& parameter, double value)
    : parameter_(&parameter), travel_(parameter_travel(parameter, value)) {}

double ControlDrag::move(double dx, double width, bool fine) {
    if (width > 0) travel_ += dx / width * (fine ? fine_share : 1.0);
    travel_ = std::clamp(travel_, 0.0, 1.0);
    return parameter_value(*parameter_, travel_);
}

double stepped_value(const ParameterDeclaration& parameter, double value, int steps, bool fine) {
    if (parameter.curve == Curve::Stepped) return std::clamp(value + steps, parameter.low, parameter.high);
    const double step = fine ? 0.001 : 0.01;
    const double travel = parameter_travel(parameter, value) + step * steps;
    return parameter_value(parameter, std::clamp(travel, 0.0, 1.0));
}

}  // namespace jawari::host::window
