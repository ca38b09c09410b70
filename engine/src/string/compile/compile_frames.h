// Coefficients of what rendering may skip.
#pragma once

#include "jawari/detail/string_model.h"

namespace jawari {

/// Fills model.flight and model.certificate from the modes, the step and the contact rows. Exact scheme only.
void set_skipping(StringModel& model);

}  // namespace jawari
