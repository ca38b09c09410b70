// What every fuzz target requires of the code under test.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/error.h"

namespace jawari::fuzz {

inline void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "fuzzing: violated: %s\n", what);
    std::abort();
}

/// A refused input is one line that names its file, with the exit code for invalid input.
inline void require_proper_refusal(const host::Error& error, const std::string& file) {
    require(error.kind == host::ErrorKind::InvalidInput, "exit code of a refused file");
    require(error.message.starts_with(file + ":"), "the message starts with the file");
    require(error.message.find('\n') == std::string::npos, "the message is one line");
}

inline void require_proper_failure(const Failure& failure) {
    require(!failure.place.empty() && !failure.allowed.empty(),
            "a failure names its place and what is allowed");
}

}  // namespace jawari::fuzz
