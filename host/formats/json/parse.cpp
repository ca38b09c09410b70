#include "formats/json/parse.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/input_file.h"
#include "base/text.h"
#include "formats/json/path.h"

namespace jawari::host::json {

namespace {

/// Line and column, both from 1, of a byte offset; columns count bytes.
std::string line_and_column(std::string_view text, std::size_t offset) {
    const auto before = text.substr(0, std::min(offset, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const auto newline = before.rfind('\n');
    const std::size_t column = before.size() - (newline == std::string_view::npos ? 0 : newline + 1);
    return std::to_string(line) + ":" + std::to_string(std::max<std::size_t>(column, 1));
}

/// The letters around the byte that the parser stopped at, which it counts from 1.
std::string_view word_around(std::string_view text, std::size_t offset) {
    const auto is_letter = [&](std::size_t i) { return (text[i] | 0x20) >= 'a' && (text[i] | 0x20) <= 'z'; };
    std::size_t first = std::min(offset, text.size());
    std::size_t last = first;
    while (last < text.size() && is_letter(last)) ++last;
    while (first > 0 && is_letter(first - 1)) --first;
    return text.substr(first, last - first);
}

/// Receives the parser's events and builds the document, so that bounds hold before memory is taken.
class Builder final : public nlohmann::json_sax<nlohmann::json> {
  public:
    Builder(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    bool null() override { return add({Null{}}) != nullptr; }
    bool boolean(bool value) override { return add({value}) != nullptr; }
    bool number_integer(std::int64_t value) override { return add({static_cast<double>(value)}) != nullptr; }
    bool number_unsigned(std::uint64_t value) override {
        return add({static_cast<double>(value)}) != nullptr;
    }
    bool number_float(double value, const std::string&) override { return add({value}) != nullptr; }
    bool string(std::string& value) override { return add({std::move(value)}) != nullptr; }
    bool binary(nlohmann::json::binary_t&) override { return fail("binary data (allowed: JSON text)"); }
    bool start_object(std::size_t) override { return open({Object{}}); }
    bool start_array(std::size_t) override { return open({Array{}}); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(std::string& name) override;
    bool parse_error(std::size_t offset, const std::string& last_token,
                     const nlohmann::json::exception& problem) override;

    Value document;
    std::optional<Error> error;

  private:
    Value* add(Value value);
    bool open(Value value);
    bool close() {
        nested_.pop_back();
        return true;
    }
    [[nodiscard]] std::string place() const;
    bool fail(const std::string& problem) {
        error = Error{ErrorKind::InvalidInput, file_ + ": " + problem};
        return false;
    }

    std::string_view text_;
    std::string file_;
    std::vector<Value*>
        nested_;  // the arrays and objects being read; stable, as only the innermost one grows
    std::size_t count_ = 0;
};

std::string Builder::place() const {
    std::string path;
    for (std::size_t i = 0; i + 1 < nested_.size(); ++i) {
        if (const auto* array = std::get_if<Array>(&nested_[i]->content))
            path = indexed(path, array->size() - 1);
        else
            path = member(path, std::get<Object>(nested_[i]->content).back().key);
    }
    return path;
}

Value* Builder::add(Value value) {
    if (++count_ > limits::values) {
        fail("the file has too many values (allowed: at most " + std::to_string(limits::values) + ")");
        return nullptr;
    }
    if (nested_.empty()) {
        document = std::move(value);
        return &document;
    }
    Value& parent = *nested_.back();
    if (auto* object = std::get_if<Object>(&parent.content)) {
        object->back().value = std::move(value);
        return &object->back().value;
    }
    auto& array = std::get<Array>(parent.content);
    if (array.size() == limits::array_items) {
        fail(Failure{whole(place()), "an array that is too long",
                     "at most " + std::to_string(limits::array_items)}
                 .line());
        return nullptr;
    }
    array.push_back(std::move(value));
    return &array.back();
}

bool Builder::open(Value value) {
    if (nested_.size() == limits::depth)
        return fail("arrays and objects are nested too deeply (allowed: " + std::to_string(limits::depth) +
                    " levels)");
    Value* added = add(std::move(value));
    if (added == nullptr) return false;
    nested_.push_back(added);
    return true;
}

bool Builder::key(std::string& name) {
    auto& object = std::get<Object>(nested_.back()->content);
    if (find(object, name) != nullptr)
        return fail(Failure{member(place(), name), "duplicate key", "each key once"}.line());
    if (object.size() == limits::object_keys)
        return fail(Failure{whole(place()), "too many keys", "at most " + std::to_string(limits::object_keys)}
                        .line());
    object.push_back({std::move(name), {}});
    return true;
}

bool Builder::parse_error(std::size_t offset, const std::string& last_token,
                          const nlohmann::json::exception& problem) {
    std::string reason = problem.what();
    if (const auto start = reason.find("syntax error while parsing"); start != std::string::npos)
        reason = reason.substr(start);
    else if (const auto end_of_tag = reason.find("] "); end_of_tag != std::string::npos)
        reason = reason.substr(end_of_tag + 2);
    if (reason.starts_with("number overflow"))
        reason = "the number " + last_token.substr(0, 60) + " is too large (allowed: finite numbers)";
    constexpr std::size_t longest = 240;
    if (reason.size() > longest) reason = reason.substr(0, longest) + "...";
    const std::string word = lower_case(word_around(text_, offset));
    if (word.starts_with("nan") || word.starts_with("inf"))
        reason += " (NaN and Infinity are not JSON; allowed: finite numbers)";
    error = Error{ErrorKind::InvalidInput, file_ + ":" + line_and_column(text_, offset) + ": " + reason};
    return false;
}

}  // namespace

Outcome<Value> parse(std::string_view text, const std::string& file) {
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
        return Error{ErrorKind::InvalidInput, file + ": the file is empty (allowed: a JSON object)"};
    Builder builder(text, file);
    if (!nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) return *builder.error;
    return std::move(builder.document);
}

Outcome<Value> parse_file(const std::string& path) {
    auto text = read_file(path, limits::file_bytes);
    if (!text) return text.error();
    return parse(text.value(), path);
}

}  // namespace jawari::host::json
