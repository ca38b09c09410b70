// A parsed JSON document as plain data.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace jawari::host::json {

struct Value;
struct Member;
using Array = std::vector<Value>;
using Object = std::vector<Member>;  ///< in the file's order, keys unique
struct Null {};

struct Value {
    std::variant<Null, bool, double, std::string, Array, Object> content;
};

struct Member {
    std::string key;
    Value value;
};

/// Null if the object has no such key.
const Value* find(const Object& object, std::string_view key);

/// The value as it appears in messages: a scalar spelled out, `an array of 3` or `an object`.
std::string describe(const Value& value);

}  // namespace jawari::host::json
