#include "formats/tuning/keyboard_map.h"

#include <string>

#include "base/text.h"
#include "formats/tuning/scala_lines.h"

namespace jawari::host {

namespace {

/// Takes the header's values one after the other; after a failure every further one is skipped.
class Header {
  public:
    explicit Header(const std::vector<ScalaLine>& lines) : lines_(lines) {}

    int whole(const char* what, int lowest, int highest) {
        const std::string allowed =
            std::string(what) + ", " + std::to_string(lowest) + " to " + std::to_string(highest);
        const ScalaLine* line = next(what, allowed);
        if (line == nullptr) return lowest;
        const auto value = whole_number(first_word(line->text));
        if (value && *value >= lowest && *value <= highest) return static_cast<int>(*value);
        failure_ = scala_failure(line->number, line->text, allowed);
        return lowest;
    }

    double frequency(const char* what) {
        const std::string allowed =
            std::string(what) + ", " + shortest(lowest_key_hz) + " to " + shortest(highest_key_hz) + " Hz";
        const ScalaLine* line = next(what, allowed);
        if (line == nullptr) return lowest_key_hz;
        const auto value = parse_number(first_word(line->text));
        if (value && *value >= lowest_key_hz && *value <= highest_key_hz) return *value;
        failure_ = scala_failure(line->number, line->text, allowed);
        return lowest_key_hz;
    }

    void refuse(const char* allowed) {
        if (!failure_) failure_ = scala_failure(lines_[at_ - 1].number, lines_[at_ - 1].text, allowed);
    }

    [[nodiscard]] const std::optional<Failure>& failure() const { return failure_; }
    [[nodiscard]] std::size_t next_line() const { return at_; }

  private:
    const ScalaLine* next(const char* what, const std::string& allowed) {
        if (failure_) return nullptr;
        if (at_ == lines_.size()) {
            failure_ = scala_missing(what, allowed);
            return nullptr;
        }
        return &lines_[at_++];
    }

    const std::vector<ScalaLine>& lines_;
    std::size_t at_ = 0;
    std::optional<Failure> failure_;
};

bool is_unmapped(std::string_view word) {
    return word == "x" || word == "X";
}

/// Unmapped keys at the end may be left out.
std::optional<Failure> read_degrees(const std::vector<ScalaLine>& lines, std::size_t first,
                                    KeyboardMap& map) {
    for (std::size_t i = first; i < lines.size(); ++i) {
        const std::string_view word = first_word(lines[i].text);
        const std::size_t key = i - first;
        if (key >= map.degrees.size()) {
            if (word.empty()) continue;
            return scala_failure(
                lines[i].number, lines[i].text,
                "nothing after the " + std::to_string(map.degrees.size()) + " keys of the map");
        }
        if (is_unmapped(word)) continue;
        if (word.empty() && i + 1 == lines.size()) break;
        const auto degree = whole_number(word);
        if (!degree || *degree < -largest_map_degree || *degree > largest_map_degree)
            return scala_failure(lines[i].number, lines[i].text,
                                 "a degree from -" + std::to_string(largest_map_degree) + " to " +
                                     std::to_string(largest_map_degree) + ", or x for a silent key");
        map.degrees[key] = static_cast<int>(*degree);
    }
    return std::nullopt;
}

}  // namespace

Result<KeyboardMap> parse_keyboard_map(std::string_view text) {
    const std::vector<ScalaLine> lines = scala_lines(text);
    Header header(lines);
    KeyboardMap map;
    const int size = header.whole("size of the map", 0, static_cast<int>(most_map_keys));
    map.first_key = header.whole("first key to retune", 0, 127);
    map.last_key = header.whole("last key to retune", 0, 127);
    if (map.last_key < map.first_key) header.refuse("a last key that is not below the first one");
    map.middle_key = header.whole("middle key", 0, 127);
    map.reference_key = header.whole("reference key", 0, 127);
    map.reference_hz = header.frequency("frequency of the reference key");
    map.formal_octave = header.whole("degree of the formal octave", 0, largest_map_degree);
    if (header.failure()) return *header.failure();
    map.degrees.resize(static_cast<std::size_t>(size));
    if (auto failure = read_degrees(lines, header.next_line(), map)) return *failure;
    return map;
}

}  // namespace jawari::host
