#include "instrument/quality.h"

namespace jawari::host {

QualityDescription at_quality(const InstrumentDescription& instrument, Quality quality) {
    if (quality == Quality::Live) return instrument.quality;
    QualityDescription chosen = instrument.studio.value_or(instrument.quality);
    if (quality == Quality::Reference) {
        chosen.contact_rate_min_hz *= 2;
        chosen.mode_limit_hz *= 2;
    }
    return chosen;
}

}  // namespace jawari::host
