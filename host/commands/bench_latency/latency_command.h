// The command line of `jawari bench-latency`.
#pragma once

#include "cli/command.h"

namespace jawari::host {

/// Registers the subcommand; parsing it sets `command`.
void add_bench_latency_command(CLI::App& app, Command& command);

}  // namespace jawari::host
