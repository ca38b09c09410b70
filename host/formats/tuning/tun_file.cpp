#include "formats/tuning/tun_file.h"

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "formats/tuning/scala_lines.h"
#include "formats/tuning/scale.h"
#include "formats/tuning/tun_formulas.h"

namespace jawari::host {

namespace {

constexpr double cents_per_key = 100;
constexpr double key_0_hz = 8.175798915643707;  // 440 2^(-69/12)
constexpr double lowest_base_hz = 1e-3;

enum class TunSection { Other, Rough, Exact, Functional, Mapping };

/// Pitches above the base frequency, by key.
using KeyCents = std::map<int, double>;

/// `Key = Value`
struct TunEntry {
    std::string key;  ///< lower case
    std::string_view value;
};

std::optional<TunEntry> entry_of(std::string_view line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) return std::nullopt;
    std::string_view value = line.substr(equals + 1);
    if (trimmed(value).starts_with('"')) {
        value = trimmed(value).substr(1);
        return TunEntry{lower_case(trimmed(line.substr(0, equals))), value.substr(0, value.find('"'))};
    }
    value = trimmed(value.substr(0, value.find(';')));
    return TunEntry{lower_case(trimmed(line.substr(0, equals))), value};
}

/// Of `note 69` or `keyboard 69` the number if it is a key; nothing otherwise, as the format asks.
std::optional<int> key_after(std::string_view word, const std::string& key) {
    if (!key.starts_with(word)) return std::nullopt;
    const auto number = whole_number(trimmed(std::string_view(key).substr(word.size())));
    if (!number || *number < 0 || *number >= static_cast<long long>(midi_keys)) return std::nullopt;
    return static_cast<int>(*number);
}

class TunReader {
  public:
    std::optional<Failure> read(const ScalaLine& line) {
        const std::string_view text = trimmed(line.text);
        if (text.empty() || text.starts_with(';')) return std::nullopt;
        if (text.starts_with('[')) return begin_section(line, text);
        const auto entry = entry_of(text);
        if (!entry || section_ == TunSection::Other) return std::nullopt;
        if (section_ == TunSection::Functional) return read_functional(line, *entry);
        if (section_ == TunSection::Mapping) return read_mapping(line, *entry);
        if (section_ == TunSection::Exact && entry->key == "basefreq") return read_base(line, entry->value);
        const auto note = key_after("note", entry->key);
        if (!note) return std::nullopt;
        const auto cents = parse_number(entry->value);
        if (!cents || !(std::abs(*cents) <= largest_scale_cents))
            return scala_failure(
                line.number, line.text,
                "cents, " + shortest(-largest_scale_cents) + " to " + shortest(largest_scale_cents));
        (section_ == TunSection::Exact ? exact_ : rough_)[*note] = *cents;
        return std::nullopt;
    }

    [[nodiscard]] Result<KeyFrequencies> frequencies() const {
        if (!exact_.empty()) return tuned(completed(exact_), base_hz_);
        if (!rough_.empty()) return tuned(completed(rough_), key_0_hz);
        if (functional_) return by_formulas();
        return scala_missing("notes", "notes in a section [Exact Tuning], [Tuning] or [Functional Tuning]");
    }

  private:
    static constexpr int highest_key = static_cast<int>(midi_keys) - 1;

    std::optional<Failure> begin_section(const ScalaLine& line, std::string_view text) {
        const std::string name = lower_case(trimmed(text.substr(1, text.find(']') - 1)));
        section_ = TunSection::Other;
        if (name == "tuning") section_ = TunSection::Rough;
        if (name == "exact tuning") section_ = TunSection::Exact;
        if (name == "functional tuning") section_ = TunSection::Functional;
        if (name == "scale begin") scales_ += 1;
        if (scales_ > 1) return scala_failure(line.number, line.text, "one scale in a file");
        if (name == "mapping") section_ = TunSection::Mapping;
        return std::nullopt;
    }

    /// `InitEqual = (69, 440)` begins anew; `note 12 = "#>-12 % 1200"` is a formula.
    std::optional<Failure> read_functional(const ScalaLine& line, const TunEntry& entry) {
        if (entry.key == "initequal") return read_equal(line, entry.value);
        const auto note = key_after("note", entry.key);
        if (!note) return std::nullopt;
        const auto formula = read_formula(*note, entry.value);
        if (!formula)
            return scala_failure(
                line.number, line.text,
                "a formula of ! # * / % + ~ that names notes 0 to " + std::to_string(highest_key));
        apply(*formula, scale_);
        functional_ = true;
        return std::nullopt;
    }

    std::optional<Failure> read_equal(const ScalaLine& line, std::string_view value) {
        const std::size_t comma = value.find(',');
        const bool bracketed = value.size() > 2 && value.front() == '(' && value.back() == ')';
        if (bracketed && comma != std::string_view::npos) {
            const auto note = whole_number(trimmed(value.substr(1, comma - 1)));
            const auto hz = parse_number(trimmed(value.substr(comma + 1, value.size() - comma - 2)));
            if (note && *note >= 0 && *note <= highest_key && hz && is_base(*hz)) {
                scale_ = equal_scale(static_cast<int>(*note), *hz);
                functional_ = true;
                return std::nullopt;
            }
        }
        return scala_failure(line.number, line.text,
                             "(note, frequency): 0 to " + std::to_string(highest_key) + ", " + base_range());
    }

    std::optional<Failure> read_mapping(const ScalaLine& line, const TunEntry& entry) {
        const auto key = key_after("keyboard", entry.key);
        if (!key && entry.key != "loopsize") return std::nullopt;
        const auto number = whole_number(entry.value);
        const long long highest = key ? highest_key : highest_key + 1;
        if (!number || *number < 0 || *number > highest)
            return scala_failure(line.number, line.text, "0 to " + std::to_string(highest));
        if (key) {
            mapping_.note_of_key[static_cast<std::size_t>(*key)] = static_cast<int>(*number);
        } else {
            mapping_.loop_size = static_cast<int>(*number);
        }
        return std::nullopt;
    }

    static bool is_base(double hz) { return hz >= lowest_base_hz && hz <= highest_key_hz; }
    static std::string base_range() {
        return shortest(lowest_base_hz) + " to " + shortest(highest_key_hz) + " Hz";
    }

    std::optional<Failure> read_base(const ScalaLine& line, std::string_view value) {
        const auto hz = parse_number(value);
        if (!hz || !is_base(*hz)) return scala_failure(line.number, line.text, base_range());
        base_hz_ = *hz;
        return std::nullopt;
    }

    /// Keys below the highest note that is given keep equal steps; above it the pattern repeats, raised by
    /// the pitch of that note.
    static std::vector<double> completed(const KeyCents& given) {
        std::vector<double> cents(midi_keys);
        const int highest = given.rbegin()->first;
        const double period = given.rbegin()->second;
        for (int key = 0; key <= highest_key; ++key) {
            const auto found = given.find(key);
            double& pitch = cents[static_cast<std::size_t>(key)];
            if (found != given.end()) {
                pitch = found->second;
            } else if (key < highest || highest == 0) {
                pitch = cents_per_key * key;
            } else {
                pitch = cents[static_cast<std::size_t>(key - highest)] + period;
            }
        }
        return cents;
    }

    static KeyFrequencies tuned(const std::vector<double>& cents, double base_hz) {
        KeyFrequencies frequencies{};
        for (std::size_t key = 0; key < midi_keys; ++key) {
            frequencies[key] = heard_hz(base_hz * std::exp2(cents[key] / cents_per_octave));
        }
        return frequencies;
    }

    [[nodiscard]] KeyFrequencies by_formulas() const {
        KeyFrequencies frequencies{};
        for (int key = 0; key <= highest_key; ++key)
            frequencies[static_cast<std::size_t>(key)] =
                heard_hz(scale_[static_cast<std::size_t>(mapping_.note(key))]);
        return frequencies;
    }

    static NoteFrequencies equal_scale(int note, double hz) {
        NoteFrequencies scale{};
        for (int n = 0; n <= highest_key; ++n)
            scale[static_cast<std::size_t>(n)] =
                hz * std::exp2(cents_per_key * (n - note) / cents_per_octave);
        return scale;
    }

    /// NaN: silent.
    static double heard_hz(double hz) {
        const bool heard = hz >= lowest_key_hz && hz <= highest_key_hz;
        return heard ? hz : std::numeric_limits<double>::quiet_NaN();
    }

    TunSection section_ = TunSection::Other;
    bool functional_ = false;
    int scales_ = 0;
    double base_hz_ = key_0_hz;
    KeyCents exact_, rough_;
    NoteFrequencies scale_ = equal_scale(69, 440);  // as formulas have left it
    TunMapping mapping_;
};

}  // namespace

Result<KeyFrequencies> parse_tun(std::string_view text) {
    TunReader reader;
    for (const ScalaLine& line : text_lines(text))
        if (auto failure = reader.read(line)) return *failure;
    return reader.frequencies();
}

}  // namespace jawari::host
