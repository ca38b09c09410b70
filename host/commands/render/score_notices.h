// What an ensemble does not play of a score, in words: one notice for each kind.
#pragma once

#include <string>
#include <vector>

#include "commands/render/ensemble.h"
#include "commands/render/score.h"

namespace jawari::host {

/// A line for each thing that is ignored or silent, without "notice:" and the name of the music.
/// `programs_choose`: program changes choose presets.
std::vector<std::string> score_notices(const Score& score, const Ensemble& ensemble, bool programs_choose);

}  // namespace jawari::host
