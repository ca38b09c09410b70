// Coefficients of what rendering may skip.
#pragma once

#include "string/compile/string_draft.h"

namespace jawari {

/// Fills what frames need, from the modes, the step and the contact rows: flight, certificate, responses.
/// Exact scheme only.
void set_skipping(StringDraft& draft);

}  // namespace jawari
