// Preconditions that debug builds check.
#pragma once

#include <cassert>

/// Ends the program with the place and the condition if it is false. Checked where NDEBUG is not defined,
/// never in a release build, where the condition is not evaluated. Neither throws nor allocates before it
/// ends the program, so it may stand in noexcept and real-time functions.
#ifdef NDEBUG
#define JAWARI_ASSERT(condition) static_cast<void>(sizeof(!(condition)))  // names stay used
#else
#define JAWARI_ASSERT(condition) assert(condition)
#endif
