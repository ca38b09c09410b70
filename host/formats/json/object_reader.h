// Reads the keys of one JSON object. The first problem of a document is kept, with its path; after it every
// read returns a default, so that readers need no test after each key.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/suggestion.h"
#include "formats/json/path.h"
#include "formats/json/value.h"
#include "jawari/result.h"

namespace jawari::host::json {

/// The first problem of a document.
class Problems {
  public:
    void add(std::string place, std::string value, std::string allowed) {
        if (!first_) first_ = Failure{std::move(place), std::move(value), std::move(allowed)};
    }
    [[nodiscard]] const std::optional<Failure>& first() const { return first_; }
    [[nodiscard]] bool any() const { return first_.has_value(); }

  private:
    std::optional<Failure> first_;
};

/// Inclusive bounds of a number.
struct Range {
    double lowest;
    double highest;
};

/// A word and what it stands for.
template <class T>
struct Choice {
    std::string_view word;
    T value;
};

class ObjectReader {
  public:
    /// Any key that is neither in `allowed` nor `comment` is a problem. The value must outlive the reader.
    ObjectReader(const Value& value, std::string path, std::vector<std::string_view> allowed,
                 Problems& problems);

    [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
    [[nodiscard]] std::string path_of(std::string_view key) const { return member(path_, key); }
    [[nodiscard]] const std::string& path() const { return path_; }
    Problems& problems() { return problems_; }

    /// The value of a required key; null, and a problem, if it is missing. `expected`: what should be there.
    const Value* require(std::string_view key, std::string_view expected);
    /// Null if the key is absent.
    [[nodiscard]] const Value* find(std::string_view key) const;

    double number(std::string_view key);
    double number(std::string_view key, Range range);
    double number_or(std::string_view key, double fallback);
    double number_or(std::string_view key, double fallback, Range range);
    /// A number without fraction.
    std::size_t whole_number(std::string_view key, std::size_t lowest, std::size_t highest);
    /// true or false.
    bool flag(std::string_view key);
    std::string text(std::string_view key);
    std::string text_or(std::string_view key, std::string fallback);
    std::vector<double> numbers(std::string_view key, std::size_t longest);
    /// Null, and a problem, unless it is an array of at most `longest` items.
    const Array* array(std::string_view key, std::size_t longest);

    /// One of the words; the list of words is what the message calls allowed.
    template <class T>
    T choice(std::string_view key, std::initializer_list<Choice<T>> choices) {
        std::string words;
        std::vector<std::string> known;
        for (const auto& each : choices) {
            words += (words.empty() ? "\"" : ", \"") + std::string(each.word) + "\"";
            known.emplace_back(each.word);
        }
        const Value* value = require(key, words);
        if (value == nullptr) return choices.begin()->value;
        const auto* word = std::get_if<std::string>(&value->content);
        for (const auto& each : choices)
            if (word != nullptr && each.word == *word) return each.value;
        problems_.add(path_of(key),
                      describe(*value) + (word == nullptr ? std::string() : did_you_mean(*word, known)),
                      words);
        return choices.begin()->value;
    }
    template <class T>
    T choice_or(std::string_view key, T fallback, std::initializer_list<Choice<T>> choices) {
        return has(key) ? choice(key, choices) : fallback;
    }

  private:
    const Object* object_ = nullptr;
    std::string path_;
    std::vector<std::string_view> allowed_;
    Problems& problems_;
};

/// A finite number within the range, or a problem at `place`.
double read_number(const Value& value, const std::string& place, std::optional<Range> range,
                   Problems& problems);

/// An array of at most `longest` items, or null and a problem at `place`.
const Array* read_array(const Value& value, const std::string& place, std::size_t longest,
                        Problems& problems);

/// An array of numbers.
std::vector<double> read_numbers(const Value& value, const std::string& place, std::size_t longest,
                                 Problems& problems);

}  // namespace jawari::host::json
