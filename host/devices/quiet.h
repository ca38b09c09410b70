// Sound libraries write what they find missing to standard error, many lines of it. While one of these lives,
// such text is collected instead, so that the program can say it in one line.
#pragma once

#include <string>
#include <string_view>

namespace jawari::host {

/// Standard error of the whole process goes to a nameless file. One at a time, by one thread.
class QuietStandardError {
  public:
    QuietStandardError();
    QuietStandardError(const QuietStandardError&) = delete;
    QuietStandardError& operator=(const QuietStandardError&) = delete;
    ~QuietStandardError() { restore(); }

    void restore();

    /// Whether that was written so far.
    [[nodiscard]] bool mentions(std::string_view part) const;

    /// The first line with letters in it that was written so far, printable; empty if there is none.
    [[nodiscard]] std::string first_line() const;

  private:
    [[nodiscard]] std::string text() const;

    int saved_ = -1;
    int collected_ = -1;
};

}  // namespace jawari::host
