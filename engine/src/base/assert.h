// Preconditions that debug builds check.
#pragma once

#include <cassert>

/// Ends the program with the place and the condition if it is false. Checked where NDEBUG is not defined,
/// never in a release build, where the condition is not evaluated. Neither throws nor allocates before it
/// ends the program, so it may stand in noexcept and real-time functions.
#define JAWARI_ASSERT(condition) assert(condition)
