// The window of an instance as a VST 3 host has it (IPlugView).
#pragma once

#include <travesty/view.h>

#include "plugin/vst3/instance.h"

namespace jawari::host::vst3 {

/// Null where no window can be opened. Its one reference is the caller's; it holds one of the instance.
v3_plugin_view** create_plugin_view(Instance& instance);

}  // namespace jawari::host::vst3
