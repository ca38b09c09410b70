#include "cli/contact_warnings.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/text.h"

namespace jawari::host {

namespace {

constexpr std::size_t most_named_parts = 3;

struct Occurrence {
    std::string name;
    std::uint64_t count = 0;
    std::uint64_t of = 0;
};

/// Those in which it occurred, the most frequent first.
std::vector<Occurrence> occurrences(const std::vector<NamedCounters>& parts, std::uint64_t Counters::*counted,
                                    std::uint64_t Counters::*of) {
    std::vector<Occurrence> found;
    for (const NamedCounters& part : parts)
        if (part.counters.*counted > 0)
            found.push_back({part.name, part.counters.*counted, part.counters.*of});
    std::stable_sort(found.begin(), found.end(),
                     [](const Occurrence& a, const Occurrence& b) { return a.count > b.count; });
    return found;
}

/// `string "a": 3 of 40 solves, string "b": 1 of 9 solves and 2 more`
std::string counted(const std::string& kind, const std::vector<Occurrence>& found, const std::string& unit) {
    std::vector<std::string> texts;
    for (const Occurrence& each : found) {
        if (texts.size() == most_named_parts) break;
        std::string text = kind;
        text.append(" ").append(in_quotes(each.name)).append(": ").append(std::to_string(each.count));
        text.append(" of ").append(std::to_string(each.of)).append(" ").append(unit);
        texts.push_back(std::move(text));
    }
    const std::size_t more = found.size() - texts.size();
    return join(texts) + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

}  // namespace

std::vector<std::string> contact_warnings(const std::string& subject, const std::string& kind,
                                          const std::vector<NamedCounters>& parts) {
    std::vector<std::string> lines;
    const std::string start = "warning: " + printable(subject) + ": ";
    if (const auto cut = occurrences(parts, &Counters::truncated_solves, &Counters::solves); !cut.empty())
        lines.push_back(start + counted(kind, cut, "solves") +
                        " were truncated; the impulses of these steps are not those of the law");
    if (const auto reset = occurrences(parts, &Counters::nonfinite_resets, &Counters::steps); !reset.empty())
        lines.push_back(start + counted(kind, reset, "steps") +
                        " left a state that was not finite; the string was put to rest");
    return lines;
}

MaybeError strict_error(const std::string& subject, std::size_t warnings) {
    if (warnings == 0) return std::nullopt;
    return Error{ErrorKind::Doubtful, subject + ": " + std::to_string(warnings) +
                                          (warnings == 1 ? " warning" : " warnings") +
                                          " (allowed: none, with --strict); the outputs are complete"};
}

}  // namespace jawari::host
