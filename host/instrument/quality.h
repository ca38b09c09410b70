// How finely an instrument is computed.
#pragma once

#include "jawari/instrument/description.h"
#include "jawari/scene/resolution.h"

namespace jawari::host {

/// Presets carry resolutions of their own, measured on themselves. Live: as the preset says. Studio: as its
/// section `studio` says; as live if it has none. Reference: twice studio's contact rate and mode limit, to
/// see what studio leaves out.
QualityDescription at_quality(const InstrumentDescription& instrument, Quality quality);

}  // namespace jawari::host
