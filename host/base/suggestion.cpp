#include "base/suggestion.h"

#include <algorithm>

#include "base/text.h"

namespace jawari::host {

namespace {

/// Nobody mistypes a longer word; keeps the cost of foreign text small.
constexpr std::size_t longest_compared_word = 64;

std::string plain_word(std::string_view word) {
    std::string plain = lower_case(word);
    std::replace(plain.begin(), plain.end(), '_', '-');
    return plain;
}

/// Nothing if they have too little in common.
std::optional<std::size_t> distance_between(std::string_view wanted, std::string_view known) {
    if (known.size() > longest_compared_word) return std::nullopt;
    const std::size_t distance = edit_distance(wanted, known);
    const std::size_t allowed = std::max<std::size_t>(1, std::max(wanted.size(), known.size()) / 3);
    if (distance > allowed || distance >= known.size()) return std::nullopt;
    return distance;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before_last.swap(last);
        last.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = a[i - 1] == b[j - 1] ? 0 : 1;
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + changed});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row[b.size()];
}

std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known) {
    if (word.empty() || word.size() > longest_compared_word) return std::nullopt;
    const std::string wanted = plain_word(word);
    std::optional<std::string> nearest;
    std::size_t least = longest_compared_word;
    for (const std::string& each : known) {
        const std::string plain = plain_word(each);
        for (const std::string& part : {plain, plain.substr(plain.rfind('/') + 1)}) {
            const auto distance = distance_between(wanted, part);
            if (!distance || *distance >= least) continue;
            least = *distance;
            nearest = each;
        }
    }
    return nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
    const auto nearest = nearest_word(word, known);
    return nearest ? "; did you mean \"" + printable(*nearest) + "\"?" : std::string();
}

}  // namespace jawari::host
