// Failures of compile(): where in the description, which value, what is allowed. No exceptions, no logging.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace jawari {

/// Why a description cannot be compiled.
struct Failure {
    std::string place;    ///< Path inside the description, spelled as in scene files:
                          ///< `strings[0].contacts[3].position_m`.
    std::string value;    ///< The offending value, printed.
    std::string allowed;  ///< What would have been accepted: a range or a sentence.

    /// One line: `strings[0].length_m: -1 (allowed: 0.001 to 100)`.
    [[nodiscard]] std::string line() const { return place + ": " + value + " (allowed: " + allowed + ")"; }
};

/// Either a value or a Failure.
template <class T>
class Result {
  public:
    Result(T value) : content_(std::move(value)) {}            // NOLINT(google-explicit-constructor)
    Result(Failure failure) : content_(std::move(failure)) {}  // NOLINT(google-explicit-constructor)

    [[nodiscard]] bool ok() const { return std::holds_alternative<T>(content_); }
    explicit operator bool() const { return ok(); }

    /// Precondition: ok().
    [[nodiscard]] T& value() { return std::get<T>(content_); }
    [[nodiscard]] const T& value() const { return std::get<T>(content_); }
    /// Precondition: !ok().
    [[nodiscard]] const Failure& failure() const { return std::get<Failure>(content_); }

  private:
    std::variant<T, Failure> content_;
};

}  // namespace jawari
