// Arbitrary bytes as a Scala keyboard map: refused with a line, or a map that tunes the reference key.
#include <cstdint>
#include <string_view>

#include "check.h"
#include "formats/tuning/tuning.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace jawari;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto map = host::parse_keyboard_map(text);
    if (!map) {
        fuzz::require_proper_failure(map.failure());
        return 0;
    }
    const auto keys = host::tune({"", {200, 700, 1200}}, map.value());
    if (!keys) {
        fuzz::require_proper_failure(keys.failure());
        return 0;
    }
    const int reference = map.value().reference_key;
    if (reference < map.value().first_key || reference > map.value().last_key) return 0;
    fuzz::require(keys.value()[static_cast<std::size_t>(reference)] == map.value().reference_hz,
                  "the reference key has its frequency");
    return 0;
}
