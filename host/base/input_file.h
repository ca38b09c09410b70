// Reading a whole file, with a bound on its size.
#pragma once

#include <cstddef>
#include <string>

#include "base/error.h"

namespace jawari::host {

/// The file's bytes; `-` is standard input. Kind File if it cannot be read, InvalidInput if it is longer
/// than `longest` bytes.
Outcome<std::string> read_file(const std::string& path, std::size_t longest);

/// Whether anything of that name exists, readable or not.
bool path_exists(const std::string& path);

}  // namespace jawari::host
