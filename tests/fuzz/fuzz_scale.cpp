// Arbitrary bytes as a Scala scale file: refused with a line, or a scale that tunes every key to a number,
// with what Ableton adds to it.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "check.h"
#include "formats/tuning/tuning.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace jawari;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto scale = host::parse_scale(text);
    if (!scale) {
        fuzz::require_proper_failure(scale.failure());
        return 0;
    }
    const auto lines = host::parse_ableton_lines(text, scale.value());
    if (!lines) {
        fuzz::require_proper_failure(lines.failure());
        return 0;
    }
    for (const auto& keys :
         {host::tune(scale.value(), host::KeyboardMap{}), host::tune(scale.value(), lines.value())}) {
        fuzz::require(keys.ok(), "maps without a pattern have a reference key");
        for (const double frequency : keys.value()) {
            const bool in_range = frequency >= host::lowest_key_hz && frequency <= host::highest_key_hz;
            fuzz::require(in_range || std::isnan(frequency), "frequencies are in range or none");
        }
    }
    return 0;
}
