// Forces and movements that follow tables, as the frames need them.
#pragma once

#include "jawari/scene/description.h"
#include "string/compile/string_draft.h"

namespace jawari {

/// Precondition: the contacts are set.
void set_drives(StringShape& shape, const StringDescription& string);

}  // namespace jawari
