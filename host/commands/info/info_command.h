// The command lines of `jawari presets` and `jawari info`.
#pragma once

#include "cli/command.h"

namespace jawari::host {

/// Register the subcommands; parsing one sets `command`.
void add_presets_command(CLI::App& app, Command& command);
void add_info_command(CLI::App& app, Command& command);

}  // namespace jawari::host
