// The command line of `jawari simulate`.
#pragma once

#include "cli/command.h"

namespace jawari::host {

/// Registers the subcommand; parsing it sets `command`.
void add_simulate_command(CLI::App& app, Command& command);

}  // namespace jawari::host
