// Arbitrary bytes as an AnaMark tuning file: refused with a line, or a frequency or none for every key.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "check.h"
#include "formats/tuning/tun_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace jawari;
    const auto keys = host::parse_tun({reinterpret_cast<const char*>(data), size});
    if (!keys) {
        fuzz::require_proper_failure(keys.failure());
        return 0;
    }
    for (const double frequency : keys.value()) {
        const bool in_range = frequency >= host::lowest_key_hz && frequency <= host::highest_key_hz;
        fuzz::require(in_range || std::isnan(frequency), "frequencies are in range or none");
    }
    return 0;
}
