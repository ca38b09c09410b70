// SIGINT, SIGTERM and SIGHUP: the first one is noticed where work polls for it, the second one ends the
// program at once. Either way no temporary file is left behind.
#pragma once

#include <string>

#include "base/error.h"

namespace jawari::host {

/// Installs the handlers, and ignores SIGPIPE and SIGXFSZ so that writing reports the failure instead.
void install_signal_handlers();

/// An Error of kind HungUp, Interrupted or Terminated once a signal has come; cheap, to be polled.
MaybeError interruption();

/// A file that the signal handler unlinks if the program is ended at once. Movable, forgets on destruction.
class TemporaryFileGuard {
  public:
    TemporaryFileGuard() = default;
    explicit TemporaryFileGuard(const std::string& path);
    TemporaryFileGuard(TemporaryFileGuard&& other) noexcept;
    TemporaryFileGuard& operator=(TemporaryFileGuard&& other) noexcept;
    TemporaryFileGuard(const TemporaryFileGuard&) = delete;
    TemporaryFileGuard& operator=(const TemporaryFileGuard&) = delete;
    ~TemporaryFileGuard() { forget(); }

    void forget() noexcept;

  private:
    int slot_ = -1;
};

}  // namespace jawari::host
