// `jawari play`.
#pragma once

#include "base/error.h"
#include "commands/play/options.h"

namespace jawari::host {

/// Plays until it is told to end. SIGINT, SIGTERM and SIGHUP are ordinary ends.
MaybeError play(const PlayOptions& options);

}  // namespace jawari::host
