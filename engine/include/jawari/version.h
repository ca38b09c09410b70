// The library's version, the one place that states it: CMake and the program read it here.
#pragma once

// Semantic Versioning 2.0.0. While the major version is 0, a new minor version may change the interface.
#define JAWARI_VERSION_MAJOR 0
#define JAWARI_VERSION_MINOR 1
#define JAWARI_VERSION_PATCH 0
/// The same as text, "major.minor.patch".
#define JAWARI_VERSION "0.1.0"

namespace jawari {

/// Version of the library that is linked, as JAWARI_VERSION has it; compare both to find a header that does
/// not belong to the library. Static storage. Any thread.
const char* version() noexcept;

}  // namespace jawari
