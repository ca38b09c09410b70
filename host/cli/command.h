// How subcommands of the program register themselves.
#pragma once

#include <functional>

#include "base/error.h"

namespace CLI {
class App;
}

namespace jawari::host {

/// What the command line asks for; set by the subcommand that was parsed, run by main().
using Command = std::function<MaybeError()>;

}  // namespace jawari::host
