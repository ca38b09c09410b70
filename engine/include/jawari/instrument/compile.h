// Instrument description -> const instrument model.
#pragma once

#include "jawari/instrument/description.h"
#include "jawari/instrument/model.h"
#include "jawari/result.h"

namespace jawari {

/// Checks every value of the description, then compiles each string at each fret for one output rate.
/// `output_rate_hz`: 8000 to 1e6. Fails if a value is out of its range; Failure::place is spelled as in
/// preset files. Threads: any. Allocates; never throws on bad values.
Result<InstrumentModel> compile_instrument(const InstrumentDescription& instrument, double output_rate_hz);

}  // namespace jawari
