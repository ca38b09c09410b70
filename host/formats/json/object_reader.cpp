#include "formats/json/object_reader.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace jawari::host::json {

namespace {

std::string range_text(std::optional<Range> range) {
    if (!range) return "a finite number";
    return "a number from " + shortest(range->lowest) + " to " + shortest(range->highest);
}

std::string whole_text(std::size_t lowest, std::size_t highest) {
    if (highest < lowest) return "none, the limit is used up";
    return "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest);
}

std::string array_text(std::size_t longest) {
    return "an array of at most " + std::to_string(longest);
}

}  // namespace

double read_number(const Value& value, const std::string& place, std::optional<Range> range,
                   Problems& problems) {
    const auto* number = std::get_if<double>(&value.content);
    const bool good = number != nullptr && std::isfinite(*number) &&
                      (!range || (*number >= range->lowest && *number <= range->highest));
    if (good) return *number;
    problems.add(whole(place), describe(value), range_text(range));
    return range ? range->lowest : 0.0;
}

const Array* read_array(const Value& value, const std::string& place, std::size_t longest,
                        Problems& problems) {
    const auto* array = std::get_if<Array>(&value.content);
    if (array != nullptr && array->size() <= longest) return array;
    problems.add(whole(place), describe(value), array_text(longest));
    return nullptr;
}

std::vector<double> read_numbers(const Value& value, const std::string& place, std::size_t longest,
                                 Problems& problems) {
    std::vector<double> numbers;
    const Array* array = read_array(value, place, longest, problems);
    if (array == nullptr) return numbers;
    numbers.reserve(array->size());
    for (std::size_t i = 0; i < array->size() && !problems.any(); ++i)
        numbers.push_back(read_number((*array)[i], indexed(place, i), std::nullopt, problems));
    return numbers;
}

ObjectReader::ObjectReader(const Value& value, std::string path, std::vector<std::string_view> allowed,
                           Problems& problems)
    : object_(std::get_if<Object>(&value.content)),
      path_(std::move(path)),
      allowed_(std::move(allowed)),
      problems_(problems) {
    if (object_ == nullptr) {
        problems_.add(whole(path_), describe(value), "an object");
        return;
    }
    for (const Member& each : *object_) {
        if (each.key == "comment" || std::find(allowed_.begin(), allowed_.end(), each.key) != allowed_.end())
            continue;
        const std::vector<std::string> words(allowed_.begin(), allowed_.end());
        problems_.add(path_of(each.key), "unknown key" + did_you_mean(each.key, words), join(words));
        return;
    }
}

const Value* ObjectReader::find(std::string_view key) const {
    return object_ == nullptr ? nullptr : json::find(*object_, key);
}

const Value* ObjectReader::require(std::string_view key, std::string_view expected) {
    const Value* value = find(key);
    if (value == nullptr) problems_.add(path_of(key), "missing", std::string(expected));
    return value;
}

double ObjectReader::number(std::string_view key) {
    const Value* value = require(key, range_text(std::nullopt));
    return value == nullptr ? 0.0 : read_number(*value, path_of(key), std::nullopt, problems_);
}

double ObjectReader::number(std::string_view key, Range range) {
    const Value* value = require(key, range_text(range));
    return value == nullptr ? range.lowest : read_number(*value, path_of(key), range, problems_);
}

double ObjectReader::number_or(std::string_view key, double fallback) {
    return has(key) ? number(key) : fallback;
}

double ObjectReader::number_or(std::string_view key, double fallback, Range range) {
    return has(key) ? number(key, range) : fallback;
}

std::size_t ObjectReader::whole_number(std::string_view key, std::size_t lowest, std::size_t highest) {
    const std::string allowed = whole_text(lowest, highest);
    const Value* value = require(key, allowed);
    if (value == nullptr) return lowest;
    const auto* number = std::get_if<double>(&value->content);
    if (number == nullptr || *number != std::floor(*number) || *number < static_cast<double>(lowest) ||
        *number > static_cast<double>(highest)) {
        problems_.add(path_of(key), describe(*value), allowed);
        return lowest;
    }
    return static_cast<std::size_t>(*number);
}

bool ObjectReader::flag(std::string_view key) {
    const Value* value = require(key, "true or false");
    if (value == nullptr) return false;
    if (const auto* flag = std::get_if<bool>(&value->content)) return *flag;
    problems_.add(path_of(key), describe(*value), "true or false");
    return false;
}

std::string ObjectReader::text(std::string_view key) {
    const Value* value = require(key, "a string");
    if (value == nullptr) return {};
    if (const auto* text = std::get_if<std::string>(&value->content)) return *text;
    problems_.add(path_of(key), describe(*value), "a string");
    return {};
}

std::string ObjectReader::text_or(std::string_view key, std::string fallback) {
    return has(key) ? text(key) : std::move(fallback);
}

std::vector<double> ObjectReader::numbers(std::string_view key, std::size_t longest) {
    const Value* value = require(key, array_text(longest));
    return value == nullptr ? std::vector<double>{} : read_numbers(*value, path_of(key), longest, problems_);
}

const Array* ObjectReader::array(std::string_view key, std::size_t longest) {
    const Value* value = require(key, array_text(longest));
    return value == nullptr ? nullptr : read_array(*value, path_of(key), longest, problems_);
}

}  // namespace jawari::host::json
