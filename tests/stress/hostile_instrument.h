// Factory presets, cut down to few strings and bent out of shape within what compile_instrument() accepts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "jawari/instrument/compile.h"
#include "jawari/instrument/description.h"
#include "jawari/result.h"

namespace jawari::stress {

/// The factory presets, read once for a run.
struct PresetShelf {
    std::vector<InstrumentDescription> presets;
};

/// Of the built-in presets; empty if one cannot be read, which is for the caller to report.
PresetShelf factory_presets();

struct HostileInstrument {
    std::string kind;
    InstrumentDescription description;
    std::vector<QualityDescription> lower;  ///< quality levels 1, 2, ...
    double output_rate_hz = 48000;
};

HostileInstrument make_hostile_instrument(const PresetShelf& shelf, std::uint64_t seed);

}  // namespace jawari::stress
