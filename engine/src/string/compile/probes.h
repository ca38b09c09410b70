// What probes read, as rows over modes.
#pragma once

#include "jawari/scene/description.h"
#include "string/compile/string_draft.h"

namespace jawari {

void set_probes(StringDraft& draft, const StringDescription& string);

}  // namespace jawari
