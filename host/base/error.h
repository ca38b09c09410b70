// Errors of the host: a kind for the program that uses it, one line for people.
#pragma once

#include <optional>
#include <string>

#include "jawari/result.h"

namespace jawari::host {

enum class ErrorKind {
    Usage,         ///< what was asked for contradicts itself or is not allowed
    InvalidInput,  ///< a scene, preset, tuning or MIDI file says something that is not allowed
    File,          ///< a file cannot be read or written
    Internal,      ///< a defect of the program, or out of memory
    Device,        ///< an audio or MIDI device or its driver cannot be used, or was lost
    Doubtful,      ///< done, but there were warnings, which --strict does not allow
    HungUp,        ///< the terminal is gone
    Interrupted,
    Terminated
};

struct Error {
    ErrorKind kind = ErrorKind::Internal;
    std::string message;  ///< one line, without a newline
};

/// Empty means success: `if (auto error = write(...)) return *error;`
using MaybeError = std::optional<Error>;

/// A value or an Error.
template <class T>
using Outcome = Result<T, Error>;

/// An invalid input file: `bass.json: strings[0].length_m: -1 (allowed: 0.001 to 100)`.
Error invalid_input(const std::string& file, const Failure& failure);

/// A setting that is not allowed: `--theta: 3 (allowed: 0.5 to 1)`.
Error usage_error(const std::string& setting, const std::string& value, const std::string& allowed);

/// A failed system call on a file: `out/x.csv: No such file or directory`. `system_error`: a value of errno.
Error file_error(const std::string& path, int system_error);

/// A file that cannot be used for a reason that the system has no number for.
Error file_error(const std::string& path, const std::string& reason);

/// Writes the message to standard error as exactly one line, whatever it contains.
void report(const std::string& message);

}  // namespace jawari::host
