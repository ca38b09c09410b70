// Boost's binary floating-point numbers of any precision, without a false alarm.
#pragma once

// GCC 14's optimiser takes a shift by whole limbs for one beyond the number (the loop that it warns of does
// not run then).
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Warray-bounds"
#endif
#include <boost/multiprecision/cpp_bin_float.hpp>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
