// A control of a parameter: how dragging, keys and double clicks move it.
#pragma once

#include "jawari/parameters.h"

namespace jawari::host::window {

/// Dragging sideways over its width moves a control over its whole way; with Shift a tenth of that.
inline constexpr double fine_share = 0.1;

/// One hold of a control by the mouse.
class ControlDrag {
  public:
    ControlDrag(const ParameterDeclaration& parameter, double value);

    /// The pointer has moved by `dx` in a control of that width. The value it comes to, in the parameter's
    /// unit.
    double move(double dx, double width, bool fine);

  private:
    const ParameterDeclaration* parameter_;
    double travel_;  ///< not rounded to steps
};

/// The value one step of an arrow key further, `steps` may be negative: a hundredth of the way, or a whole
/// step; a thousandth if `fine`. Threads: any.
double stepped_value(const ParameterDeclaration& parameter, double value, int steps, bool fine);

}  // namespace jawari::host::window
