// Marks functions that may run on the audio thread. The library's rules for threads stand here; each function
// says in its comment which one holds for it.
//
// - "Threads: any." The function uses its arguments and constants alone. Two threads may call it at once,
// with
//   the same const arguments too.
// - "Threads: one at a time per state." Two threads may call it at once with different states. They may share
//   the model: a model is const after compile() or compile_instrument(). A state may move from one thread to
//   another if something orders the two threads (a lock, a queue).
// - "Realtime-safe." The function never allocates, locks, throws, logs or makes a system call, and its work
// is
//   bounded by sizes that compile() has checked.
// - "Allocates." It takes memory and must not run on the audio thread.
#pragma once

/// Marks a realtime-safe function. Clang 20 and later check it with -Wfunction-effects; for other compilers
/// it is plain noexcept.
#if defined(__clang__) && __clang_major__ >= 20
#define JAWARI_REALTIME noexcept [[clang::nonblocking]]
#else
#define JAWARI_REALTIME noexcept
#endif
