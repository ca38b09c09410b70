// The library's version, the one place that states it: CMake and the program read it here.
#pragma once

/// Major version of Semantic Versioning 2.0.0. While it is 0, a new minor version may change the interface.
#define JAWARI_VERSION_MAJOR 0
/// Minor version.
#define JAWARI_VERSION_MINOR 1
/// Patch version: no change of the interface.
#define JAWARI_VERSION_PATCH 0
/// The version as text, "major.minor.patch".
#define JAWARI_VERSION "0.1.0"

/// The engine. Everything public is in it; jawari::detail is not for use.
namespace jawari {

/// Version of the library that is linked, as JAWARI_VERSION spells it. If both differ, the headers do not
/// belong to the library. The text has static storage. Threads: any; realtime-safe.
const char* version() noexcept;

}  // namespace jawari
