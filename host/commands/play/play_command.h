// `jawari play` and `jawari devices`: the command line.
#pragma once

#include "cli/command.h"

namespace jawari::host {

void add_play_command(CLI::App& app, Command& command);
void add_devices_command(CLI::App& app, Command& command);

}  // namespace jawari::host
