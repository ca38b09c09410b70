// `jawari render`: MIDI files become WAV files.
#pragma once

#include "base/error.h"
#include "commands/render/options.h"

namespace jawari::host {

/// Prints notices, warnings and summaries. Of several files each is rendered, whatever becomes of the others;
/// every failure prints its line, and the last one is returned.
MaybeError render(const RenderOptions& options);

}  // namespace jawari::host
