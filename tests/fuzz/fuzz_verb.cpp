// Arbitrary bytes as a line of the shell: refused with a reason, or a call whose arguments have the types of
// its rules. And as a line that is to be completed.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "check.h"
#include "commands/play/completion.h"
#include "commands/play/verbs.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace jawari;
    const std::string_view line(reinterpret_cast<const char*>(data), size);
    const auto presets = [] { return std::vector<std::string>{"bass-fretted", "sitar"}; };
    for (const std::string& word : host::completions(line, presets))
        fuzz::require(word.starts_with(host::last_word(line)), "completions continue what was typed");
    const auto call = host::parse_line(line);
    if (!call) {
        fuzz::require(!call.error().message.empty(), "a reason");
    } else if (call.value()) {
        const auto rules = host::arguments_of(*call.value()->verb);
        fuzz::require(call.value()->arguments.size() <= rules.size(), "no more arguments than rules");
    }
    return 0;
}
