#include "formats/tuning/scale.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text.h"
#include "formats/tuning/scala_lines.h"

namespace jawari::host {

namespace {

const char* const pitch_allowed =
    "a ratio of whole numbers above 0, of up to 1000 digits each, such as 3/2, or cents with a period such "
    "as 701.955, up to 120000";

/// log2 of a whole number above 0 of any length. Digits beyond the 18 first change it by less than 1e-17.
std::optional<double> log2_of_digits(std::string_view digits) {
    constexpr std::size_t longest = 1000, counted = 18;
    while (digits.starts_with('0')) digits.remove_prefix(1);
    if (digits.empty() || digits.size() > longest) return std::nullopt;
    if (digits.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
    const auto first = whole_number(digits.substr(0, counted));
    const auto rest = static_cast<double>(digits.size() - std::min(digits.size(), counted));
    return std::log2(static_cast<double>(*first)) + rest * std::log2(10.0);
}

std::optional<double> ratio_cents(std::string_view numerator, std::string_view denominator) {
    const auto above = whole_number(numerator);
    const auto below = whole_number(denominator);
    if (!above || !below) {
        const auto log_above = log2_of_digits(numerator), log_below = log2_of_digits(denominator);
        if (!log_above || !log_below) return std::nullopt;
        return cents_per_octave * (*log_above - *log_below);
    }
    if (*above <= 0 || *below <= 0) return std::nullopt;
    // log2 of the quotient: exact for octaves, and n/d loses no more than an ulp.
    return cents_per_octave * std::log2(static_cast<double>(*above) / static_cast<double>(*below));
}

std::optional<double> plain_cents(std::string_view word) {
    if (word.find_first_not_of("+-.0123456789") != std::string_view::npos) return std::nullopt;
    return parse_number(word);
}

/// `5/4`, also with blanks around the slash: what follows a value is ignored, but a slash belongs to it.
std::optional<double> ratio_with_slash(std::string_view text, std::size_t slash) {
    return ratio_cents(trimmed(text.substr(0, slash)), first_word(text.substr(slash + 1)));
}

std::optional<double> pitch_cents(std::string_view text) {
    const std::string_view word = first_word(text);
    const std::string_view rest = trimmed(trimmed(text).substr(word.size()));
    const std::size_t slash = text.find('/');
    if (word.find('/') != std::string_view::npos || rest.starts_with('/'))
        return ratio_with_slash(text, slash);
    if (word.find('.') != std::string_view::npos) return plain_cents(word);
    return ratio_cents(word, "1");
}

Result<std::size_t> note_count(const ScalaLine& line) {
    const auto count = whole_number(trimmed(line.text));
    if (count && *count >= 0 && *count <= static_cast<long long>(most_scale_notes))
        return static_cast<std::size_t>(*count);
    return scala_failure(line.number, line.text,
                         "the number of notes, 0 to " + std::to_string(most_scale_notes));
}

}  // namespace

Result<Scale> parse_scale(std::string_view text) {
    const std::vector<ScalaLine> lines = scala_lines(text);
    if (lines.empty()) return scala_missing("description", "a line of description, which may be empty");
    if (lines.size() < 2)
        return scala_missing("number of notes", "the number of notes after the description");
    const auto count = note_count(lines[1]);
    if (!count) return count.failure();
    Scale scale;
    scale.description = std::string(trimmed(lines[0].text));
    const std::size_t end = 2 + count.value();
    for (std::size_t i = 2; i < end; ++i) {
        if (i == lines.size())
            return scala_missing("note " + std::to_string(i - 1),
                                 "a pitch for each of the " + std::to_string(count.value()) + " notes");
        const auto cents = pitch_cents(lines[i].text);
        if (!cents || !(std::abs(*cents) <= largest_scale_cents))
            return scala_failure(lines[i].number, lines[i].text, pitch_allowed);
        scale.cents.push_back(*cents);
    }
    for (std::size_t i = end; i < lines.size(); ++i) {
        if (!trimmed(lines[i].text).empty())
            return scala_failure(lines[i].number, lines[i].text,
                                 "nothing after the " + std::to_string(count.value()) + " notes");
    }
    return scale;
}

double degree_cents(const Scale& scale, long long degree) {
    if (scale.cents.empty()) return 0;
    const auto count = static_cast<long long>(scale.cents.size());
    const long long index = (degree % count + count) % count;
    const long long period = (degree - index) / count;
    const double within = index == 0 ? 0.0 : scale.cents[static_cast<std::size_t>(index - 1)];
    return static_cast<double>(period) * scale.cents.back() + within;
}

}  // namespace jawari::host
