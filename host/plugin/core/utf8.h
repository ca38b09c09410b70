// Text of files of any age as UTF-8, which JSON asks for.
#pragma once

#include <string>
#include <string_view>

namespace jawari::host {

/// The text itself if it is UTF-8; else each of its bytes as a character of ISO 8859-1. Threads: any.
std::string as_utf8(std::string_view text);

}  // namespace jawari::host
