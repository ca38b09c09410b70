#include "formats/tuning/ableton.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/suggestion.h"
#include "base/text.h"
#include "formats/tuning/scala_lines.h"

namespace jawari::host {

namespace {

constexpr int middle_c_key = 60;
constexpr double middle_c_hz = 261.6255653005986;  // 440 2^(-9/12)

/// `! @ABL WORD ARGUMENTS`
struct Directive {
    std::size_t line = 0;
    std::string_view text;  ///< from the word on
    std::vector<std::string_view> words;
};

/// Words of a line, from the second on; those in double quotes may hold blanks.
std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
        std::size_t length = first_word(text).size();
        if (text.front() == '"' && text.find('"', 1) != std::string_view::npos)
            length = text.find('"', 1) + 1;
        words.push_back(text.substr(0, length));
        text.remove_prefix(length);
    }
    return words;
}

std::optional<Directive> directive_of(const ScalaLine& line) {
    constexpr std::string_view mark = "@ABL";
    std::string_view text = trimmed(line.text.substr(1));
    if (first_word(text) != mark) return std::nullopt;
    text = trimmed(text.substr(mark.size()));
    return Directive{line.number, text, words_of(text)};
}

class AbletonReader {
  public:
    explicit AbletonReader(const Scale& scale) : notes_(static_cast<int>(scale.cents.size())) {
        if (!scale.cents.empty()) period_ = scale.cents.back();
    }

    std::optional<Failure> read(const Directive& directive) {
        const std::vector<std::string> known{"REFERENCE_PITCH",
                                             "NOTE_RANGE_BY_FREQUENCY",
                                             "NOTE_RANGE_BY_INDEX",
                                             "NOTE_NAMES",
                                             "SOURCE",
                                             "LINK"};
        const std::string word(directive.words.empty() ? "" : directive.words.front());
        if (word == known[0]) return read_reference(directive);
        if (word == known[1]) return read_frequencies(directive);
        if (word == known[2]) return read_indices(directive);
        if (std::find(known.begin(), known.end(), word) != known.end()) return std::nullopt;
        return Failure{"line " + std::to_string(directive.line), in_quotes(word) + did_you_mean(word, known),
                       join(known)};
    }

    [[nodiscard]] const AbletonLines& lines() const { return lines_; }

  private:
    static std::optional<int> whole(const Directive& directive, std::size_t word, int lowest, int highest) {
        const auto value = whole_number(directive.words[word]);
        if (!value || *value < lowest || *value > highest) return std::nullopt;
        return static_cast<int>(*value);
    }

    static std::optional<double> frequency(const Directive& directive, std::size_t word) {
        const auto value = parse_number(directive.words[word]);
        if (!value || !(*value >= lowest_key_hz && *value <= highest_range_hz)) return std::nullopt;
        return value;
    }

    static Failure refusal_of(const Directive& directive, std::string allowed) {
        return scala_failure(directive.line, directive.text, std::move(allowed));
    }

    std::optional<Failure> read_reference(const Directive& directive) {
        if (lines_.reference) return refusal_of(directive, "one REFERENCE_PITCH");
        if (notes_ == 0 || !(period_ > 0))
            return refusal_of(directive, "none, as the scale does not repeat above itself");
        const std::string allowed =
            "REFERENCE_PITCH OCTAVE INDEX HZ: " + std::to_string(lowest_ableton_octave) + " to " +
            std::to_string(highest_ableton_octave) + ", 0 to " + std::to_string(notes_ - 1) + ", " +
            shortest(lowest_key_hz) + " to " + shortest(highest_key_hz);
        if (directive.words.size() != 4) return refusal_of(directive, allowed);
        const auto octave = whole(directive, 1, lowest_ableton_octave, highest_ableton_octave);
        const auto index = whole(directive, 2, 0, notes_ - 1);
        const auto hz = frequency(directive, 3);
        if (!octave || !index || !hz || *hz > highest_key_hz) return refusal_of(directive, allowed);
        lines_.reference = {*octave, *index, *hz};
        return std::nullopt;
    }

    std::optional<Failure> read_frequencies(const Directive& directive) {
        const std::string allowed = "NOTE_RANGE_BY_FREQUENCY LOWEST [HIGHEST], " + shortest(lowest_key_hz) +
                                    " to " + shortest(highest_range_hz) + " Hz, the only range";
        const std::size_t count = directive.words.size();
        if (has_range_ || count < 2 || count > 3) return refusal_of(directive, allowed);
        has_range_ = true;
        const auto lowest = frequency(directive, 1);
        const auto highest = count == 3 ? frequency(directive, 2) : std::optional<double>(lines_.highest_hz);
        if (!lowest || !highest || *highest < *lowest) return refusal_of(directive, allowed);
        lines_.lowest_hz = *lowest;
        lines_.highest_hz = *highest;
        return std::nullopt;
    }

    std::optional<long long> note(const Directive& directive, std::size_t word) const {
        const auto octave = whole(directive, word, -furthest_range_octave, furthest_range_octave);
        const auto index = whole(directive, word + 1, 0, notes_ - 1);
        if (!octave || !index) return std::nullopt;
        return static_cast<long long>(*octave - lines_.reference->octave) * notes_ + *index;
    }

    std::optional<Failure> read_indices(const Directive& directive) {
        const std::string allowed =
            "NOTE_RANGE_BY_INDEX OCTAVE INDEX [OCTAVE INDEX], lowest and highest, after REFERENCE_PITCH, the "
            "only "
            "range; indices 0 to " +
            std::to_string(notes_ - 1);
        const std::size_t count = directive.words.size();
        if (has_range_ || !lines_.reference || (count != 3 && count != 5))
            return refusal_of(directive, allowed);
        has_range_ = true;
        lines_.lowest_note = note(directive, 1);
        if (count == 5) lines_.highest_note = note(directive, 3);
        const bool bad = !lines_.lowest_note || (count == 5 && !lines_.highest_note);
        if (bad || (lines_.highest_note && *lines_.highest_note < *lines_.lowest_note))
            return refusal_of(directive, allowed);
        return std::nullopt;
    }

    /// Live's own limit lies a little above what is heard.
    static constexpr double highest_range_hz = 100000;

    int notes_;
    double period_ = 0;
    bool has_range_ = false;
    AbletonLines lines_;
};

/// Of the notes that AbletonLines counts, the one nearest to middle C [cents].
long long note_at_middle_c(const Scale& scale, const AbletonLines::Reference& reference) {
    const double wanted =
        cents_per_octave * std::log2(middle_c_hz / reference.hz) + degree_cents(scale, reference.index);
    const auto count = static_cast<long long>(scale.cents.size());
    // Periods are at least a rounding above 0: such notes lie far away, keys do not.
    constexpr double furthest = 1e6;
    const auto period =
        static_cast<long long>(std::clamp(std::floor(wanted / scale.cents.back()), -furthest, furthest));
    long long nearest = period * count;
    for (long long note = (period - 1) * count; note <= (period + 2) * count; ++note) {
        const auto off = [&](long long each) { return std::abs(degree_cents(scale, each) - wanted); };
        if (off(note) < off(nearest)) nearest = note;
    }
    return nearest;
}

}  // namespace

Result<AbletonLines> parse_ableton_lines(std::string_view text, const Scale& scale) {
    AbletonReader reader(scale);
    for (const ScalaLine& line : scala_comments(text)) {
        const auto directive = directive_of(line);
        if (!directive) continue;
        if (auto failure = reader.read(*directive)) return *failure;
    }
    return reader.lines();
}

KeyboardMap ableton_map(const Scale& scale, const AbletonLines& lines) {
    KeyboardMap map;
    if (!lines.reference) return map;
    constexpr long long furthest = 1 << 24U;
    const long long middle = std::clamp(note_at_middle_c(scale, *lines.reference), -furthest, furthest);
    map.middle_key = middle_c_key - static_cast<int>(middle);
    map.reference_key = map.middle_key + lines.reference->index;
    map.reference_hz = lines.reference->hz;
    return map;
}

}  // namespace jawari::host
