// JSON text -> Value, with line and column of syntax errors and bounds against hostile files.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/error.h"
#include "formats/json/value.h"

namespace jawari::host::json {

namespace limits {
inline constexpr std::size_t file_bytes = std::size_t{64} << 20U;
inline constexpr std::size_t depth = 64;           ///< of arrays and objects in each other
inline constexpr std::size_t array_items = 65536;  ///< in one array
inline constexpr std::size_t object_keys = 1024;   ///< in one object
inline constexpr std::size_t values = 4'000'000;   ///< in the whole file
}  // namespace limits

/// Strict JSON (RFC 8259): no comments, no NaN, nothing after the value; duplicate keys are errors.
/// Errors are of kind InvalidInput and read `FILE:LINE:COLUMN: what is wrong`, or name the path of a
/// duplicate key.
Outcome<Value> parse(std::string_view text, const std::string& file);

/// Reads and parses a file.
Outcome<Value> parse_file(const std::string& path);

}  // namespace jawari::host::json
