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

namespace jawari::host {

namespace {

constexpr double cents_per_key = 100;
constexpr double key_0_hz = 8.175798915643707;  // 440 2^(-69/12)
constexpr double lowest_base_hz = 1e-3;

enum class TunSection { Other, Rough, Exact, Mapping };

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
    if (trimmed(value).starts_with('"'))
        return TunEntry{lower_case(trimmed(line.substr(0, equals))), trimmed(value)};
    value = trimmed(value.substr(0, value.find(';')));
    return TunEntry{lower_case(trimmed(line.substr(0, equals))), value};
}

/// `note 69`; nothing for other keys.
std::optional<long long> note_of(const std::string& key) {
    constexpr std::string_view word = "note";
    if (!key.starts_with(word)) return std::nullopt;
    return whole_number(trimmed(std::string_view(key).substr(word.size())));
}

class TunReader {
  public:
    std::optional<Failure> read(const ScalaLine& line) {
        const std::string_view text = trimmed(line.text);
        if (text.empty() || text.starts_with(';')) return std::nullopt;
        if (text.starts_with('[')) return begin_section(line, text);
        const auto entry = entry_of(text);
        if (!entry || section_ == TunSection::Other) return std::nullopt;
        if (section_ == TunSection::Mapping) return refuse_mapping(line, *entry);
        if (section_ == TunSection::Exact && entry->key == "basefreq") return read_base(line, entry->value);
        const auto note = note_of(entry->key);
        if (!note || *note < 0 || *note > highest_key) return std::nullopt;  // as the format asks
        const auto cents = parse_number(entry->value);
        if (!cents || !(std::abs(*cents) <= largest_scale_cents))
            return scala_failure(
                line.number, line.text,
                "cents, " + shortest(-largest_scale_cents) + " to " + shortest(largest_scale_cents));
        (section_ == TunSection::Exact ? exact_ : rough_)[static_cast<int>(*note)] = *cents;
        return std::nullopt;
    }

    [[nodiscard]] Result<KeyFrequencies> frequencies() const {
        if (!exact_.empty()) return tuned(completed(exact_), base_hz_);
        if (!rough_.empty()) return tuned(completed(rough_), key_0_hz);
        const std::string allowed = "notes in a section [Exact Tuning] or [Tuning]";
        if (functional_line_ > 0)
            return scala_failure(functional_line_, "[Functional Tuning] alone",
                                 allowed + "; formulas are not read");
        return scala_missing("notes", allowed);
    }

  private:
    static constexpr int highest_key = static_cast<int>(midi_keys) - 1;

    std::optional<Failure> begin_section(const ScalaLine& line, std::string_view text) {
        const std::string name = lower_case(trimmed(text.substr(1, text.find(']') - 1)));
        section_ = TunSection::Other;
        if (name == "tuning") section_ = TunSection::Rough;
        if (name == "exact tuning") section_ = TunSection::Exact;
        if (name == "functional tuning") functional_line_ = line.number;
        if (name == "scale begin") scales_ += 1;
        if (scales_ > 1) return scala_failure(line.number, line.text, "one scale in a file");
        if (name == "mapping") section_ = TunSection::Mapping;
        return std::nullopt;
    }

    /// A mapping without keys changes nothing.
    static std::optional<Failure> refuse_mapping(const ScalaLine& line, const TunEntry& entry) {
        if (entry.key == "loopsize" && entry.value == "0") return std::nullopt;
        return scala_failure(line.number, line.text, "no key that plays the note of another ([Mapping])");
    }

    std::optional<Failure> read_base(const ScalaLine& line, std::string_view value) {
        const auto hz = parse_number(value);
        if (!hz || !(*hz >= lowest_base_hz && *hz <= highest_key_hz))
            return scala_failure(line.number, line.text,
                                 shortest(lowest_base_hz) + " to " + shortest(highest_key_hz) + " Hz");
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
            const double hz = base_hz * std::exp2(cents[key] / cents_per_octave);
            const bool heard = hz >= lowest_key_hz && hz <= highest_key_hz;
            frequencies[key] = heard ? hz : std::numeric_limits<double>::quiet_NaN();
        }
        return frequencies;
    }

    TunSection section_ = TunSection::Other;
    std::size_t functional_line_ = 0;
    int scales_ = 0;
    double base_hz_ = key_0_hz;
    KeyCents exact_, rough_;
};

}  // namespace

Result<KeyFrequencies> parse_tun(std::string_view text) {
    TunReader reader;
    for (const ScalaLine& line : text_lines(text))
        if (auto failure = reader.read(line)) return *failure;
    return reader.frequencies();
}

}  // namespace jawari::host
