// Scene description -> const scene model.
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/result.h"
#include "jawari/scene/description.h"

namespace jawari {

/// Checks every value of the description, then computes modes, step coefficients, contact rows, the Delassus
/// operator and the initial state. A string that starts below an obstacle is first brought to static
/// equilibrium against it. Contacts whose Delassus diagonal is below 1e-12 of the largest are dropped
/// (StringModel::contact_of_description), or refused if they lie above the rest line. Fails at the first
/// value out of its range; Failure::place is spelled as in scene files. Threads: any. Allocates; never throws
/// on bad values.
Result<SceneModel> compile(const SceneDescription& scene);

}  // namespace jawari
