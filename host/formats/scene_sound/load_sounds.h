// Sound files as tables of forces and heights.
#pragma once

#include "base/error.h"
#include "base/file_plan.h"
#include "formats/scene/scene.h"

namespace jawari::host {

/// Names the scene's sound files to the plan, so that no output replaces one.
void plan_sounds(const Scene& scene, FilePlan& files);

/// Reads the sound files that tables name, relative to the scene's folder, and samples them
/// (resolve_defaults()).
MaybeError load_sounds(Scene& scene);

}  // namespace jawari::host
