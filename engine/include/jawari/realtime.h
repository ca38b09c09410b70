// Marks functions that may run on the audio thread: they never allocate, lock, throw, log or make a system
// call.
#pragma once

// Clang 20 and later check the mark with -Wfunction-effects; other compilers see plain noexcept.
#if defined(__clang__) && __clang_major__ >= 20
#define JAWARI_REALTIME noexcept [[clang::nonblocking]]
#else
#define JAWARI_REALTIME noexcept
#endif
