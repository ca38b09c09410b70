// description -> const model. May allocate; fails with a reason; never throws on bad values.
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/result.h"
#include "jawari/scene/description.h"

namespace jawari {

/// Checks every value of the description, then computes modes, step coefficients, contact rows, the Delassus
/// operator and the initial state. A string that starts below an obstacle is first brought to static
/// equilibrium against it. Contacts whose Delassus diagonal is below 1e-12 of the largest are dropped, or
/// refused if they lie above the rest line.
Result<SceneModel> compile(const SceneDescription& scene);

}  // namespace jawari
