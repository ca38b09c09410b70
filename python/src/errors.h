// Errors of the host as Python's exceptions, and Ctrl-C while the host works.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <string>
#include <utility>

#include "base/error.h"
#include "recording.h"

namespace jawari::python {

/// Becomes jawari.UsageError and its like (python/jawari/errors.py) at the border to Python.
class HostError final : public std::exception {
  public:
    explicit HostError(host::Error error) : error_(std::move(error)) {}
    [[nodiscard]] const char* what() const noexcept override { return error_.message.c_str(); }
    [[nodiscard]] host::ErrorKind kind() const noexcept { return error_.kind; }

  private:
    host::Error error_;
};

/// To be called once, while the module is made.
void translate_host_errors();

/// Throws the error, or the Python exception that caused it. With the GIL.
[[noreturn]] void raise(const host::Error& error);

template <class T>
T value_or_raise(host::Outcome<T>&& outcome) {
    if (!outcome) raise(outcome.error());
    return std::move(outcome.value());
}

/// Lets Python's signal handlers run, some thirty times a second, and ends the work if one of them raises:
/// the exception stays set for raise(). To be called without the GIL.
Poll signal_poll();

}  // namespace jawari::python
