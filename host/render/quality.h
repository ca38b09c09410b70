// How finely an instrument is computed.
#pragma once

#include <string>

#include "jawari/instrument_description.h"

namespace jawari::host {

enum class Quality {
    Live,      ///< as the preset says: for playing
    Studio,    ///< as its section `studio` says; as live if it has none
    Reference  ///< twice studio's contact rate and mode limit: to see what studio leaves out
};

QualityDescription at_quality(const InstrumentDescription& instrument, Quality quality);

/// `live`, `studio`, `reference`.
std::string quality_text(Quality quality);

}  // namespace jawari::host
