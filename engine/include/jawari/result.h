// Results of functions that can fail: a value, or the reason why there is none. No exceptions, no logging.
#pragma once

#include <cassert>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace jawari {

/// Why a description cannot be compiled.
struct Failure {
    std::string place;    ///< path inside the description, spelled as in scene and preset files:
                          ///< `strings[0].contacts[3].position_m`
    std::string value;    ///< the offending value, printed
    std::string allowed;  ///< what would have been accepted: a range or a sentence

    /// The failure as one line: `strings[0].length_m: -1 (allowed: 0.001 to 100)`. Threads: any. Allocates.
    [[nodiscard]] std::string line() const { return place + ": " + value + " (allowed: " + allowed + ")"; }
};

/// Either a value of type T or an error of type E. Reading the one that is not there is a mistake of the
/// caller: debug builds assert it, release builds throw std::bad_variant_access. Threads: as of T and E.
template <class T, class E = Failure>
class [[nodiscard]] Result {
    static_assert(!std::is_same_v<T, E>, "a value must differ from an error by its type");

  public:
    /// Success.
    Result(T value) : content_(std::move(value)) {}  // NOLINT(google-explicit-constructor)
    /// Failure.
    Result(E error) : content_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

    /// Whether there is a value.
    [[nodiscard]] bool ok() const noexcept { return std::holds_alternative<T>(content_); }
    /// Whether there is a value.
    explicit operator bool() const noexcept { return ok(); }

    /// The value. Precondition: ok().
    [[nodiscard]] T& value() & { return of<T>(content_); }
    /// The value. Precondition: ok().
    [[nodiscard]] const T& value() const& { return of<T>(content_); }
    /// The value, moved out of a result that is not needed any more. Precondition: ok().
    [[nodiscard]] T value() && { return std::move(of<T>(content_)); }
    /// The value. Precondition: ok().
    [[nodiscard]] T& operator*() & { return value(); }
    /// The value. Precondition: ok().
    [[nodiscard]] const T& operator*() const& { return value(); }
    /// The value, moved out of a result that is not needed any more. Precondition: ok().
    [[nodiscard]] T operator*() && { return std::move(*this).value(); }
    /// A member of the value. Precondition: ok().
    [[nodiscard]] T* operator->() { return &value(); }
    /// A member of the value. Precondition: ok().
    [[nodiscard]] const T* operator->() const { return &value(); }

    /// The error, by the name that std::expected gives it. Precondition: !ok().
    [[nodiscard]] const E& error() const { return of<E>(content_); }
    /// The error. Precondition: !ok().
    [[nodiscard]] const E& failure() const { return error(); }

  private:
    template <class Part, class Content>
    static auto& of(Content& content) {
        assert(std::holds_alternative<Part>(content));
        return std::get<Part>(content);
    }

    std::variant<T, E> content_;
};

}  // namespace jawari
