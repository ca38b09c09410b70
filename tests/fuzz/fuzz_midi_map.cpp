// Arbitrary bytes as a MIDI map: refused properly, or a map whose every value is inside its parameter's
// range.
#include <cstdint>
#include <string>

#include "check.h"
#include "midi/read_midi_map.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace jawari;
    const auto map = host::read_midi_map(std::string(data, data + size), "fuzz.json");
    if (!map) {
        fuzz::require_proper_refusal(map.error(), "fuzz.json");
        return 0;
    }
    for (std::size_t i = 0; i < map.value().count; ++i) {
        const host::MidiBinding& binding = map.value().bindings[i];
        const ParameterDeclaration& parameter = declaration_of(binding.parameter);
        for (int value = 0; value < 128; ++value) {
            const double moved = host::bound_value(binding, host::control_travel(value, 7));
            fuzz::require(moved >= parameter.low && moved <= parameter.high,
                          "values stay in the parameter's range");
        }
    }
    return 0;
}
