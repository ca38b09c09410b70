// Arbitrary bytes as the state of a plugin: refused properly, or a state that is written as itself again.
#include <cstdint>
#include <string_view>

#include "check.h"
#include "plugin/core/plugin_state.h"
#include "plugin/core/utf8.h"

using namespace jawari;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const std::string utf8 = host::as_utf8(text);
    fuzz::require(host::as_utf8(utf8) == utf8, "text that was made UTF-8 stays as it is");
    const auto state = host::read_plugin_state(text);
    if (!state) {
        fuzz::require_proper_refusal(state.error(), "plugin state");
        return 0;
    }
    for (const ParameterDeclaration& parameter : parameter_table()) {
        const double value = state.value().parameters[static_cast<std::size_t>(parameter.id)];
        fuzz::require(value >= parameter.low && value <= parameter.high, "values are in their ranges");
    }
    const auto again = host::read_plugin_state(host::write_plugin_state(state.value()));
    fuzz::require(again.ok() && again.value() == state.value(), "a state is written as itself");
    return 0;
}
