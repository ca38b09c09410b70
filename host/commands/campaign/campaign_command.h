// `jawari campaign`: hands over to the Python package, which runs campaigns (docs/campaigns.md).
#pragma once

#include "cli/command.h"

namespace jawari::host {

void add_campaign_command(CLI::App& app, Command& command);

}  // namespace jawari::host
