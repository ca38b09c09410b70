// `jawari render`: a MIDI file becomes a WAV file.
#pragma once

#include "common/error.h"
#include "render/options.h"

namespace jawari::host {

MaybeError render(const RenderOptions& options);

}  // namespace jawari::host
