// The command line overrides the scene file; errors name whichever of the two said it.
#pragma once

#include "base/error.h"
#include "commands/simulate/options.h"
#include "formats/scene/scene.h"

namespace jawari::host {

/// Applies the overrides to the scene. Fails if they do not fit together.
MaybeError apply_overrides(const Overrides& overrides, Scene& scene);

/// A failure of compile(), as an error of the option or of the file that caused it.
Error explain(const Failure& failure, const Overrides& overrides, const Scene& scene);

}  // namespace jawari::host
