#include "formats/tuning/tun_formulas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <string>

#include "base/text.h"
#include "formats/tuning/scala_lines.h"
#include "formats/tuning/scale.h"

namespace jawari::host {

namespace {

constexpr int notes_of_scale = static_cast<int>(midi_keys);
/// Longer than any scale: to its end.
constexpr int open_loop = 999;

bool is_note(long long note) {
    return note >= 0 && note < notes_of_scale;
}

/// What stands before the next operator.
std::string_view operand(std::string_view text, std::size_t& at) {
    const std::size_t from = at;
    const auto ends = [&](char c) {
        if (c == '+') {  // of an exponent, or the first of a number
            const bool exponent = at > from && (text[at - 1] == 'e' || text[at - 1] == 'E');
            return at != from && !exponent && text[at - 1] != '=' && text[at - 1] != '>';
        }
        return c == '!' || c == '#' || c == '*' || c == '/' || c == '%' || c == '~';
    };
    while (at < text.size() && !ends(text[at])) ++at;
    return text.substr(from, at - from);
}

std::optional<double> number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto value = parse_number(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<int> count(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto value = whole_number(text);
    if (!value || std::llabs(*value) > open_loop) return std::nullopt;
    return static_cast<int>(*value);
}

std::optional<FormulaTerm> term(std::string_view text) {
    FormulaTerm read;
    if (text.starts_with('=') || text.starts_with('>')) {
        const bool distance = text.front() == '>';
        const auto notes = count(text.substr(1));
        if (!notes || (!distance && !is_note(*notes))) return std::nullopt;
        read.kind = distance ? FormulaTerm::Kind::Distance : FormulaTerm::Kind::Note;
        read.notes = *notes;
        return read;
    }
    const auto value = number(text);
    if (!value) return std::nullopt;
    read.value_hz = *value;
    return read;
}

template <class Value, class Read>
bool take(Value& value, const std::optional<Read>& read) {
    if (read) value = *read;
    return read.has_value();
}

bool read_operation(TunFormula& formula, char operation, std::string_view text) {
    switch (operation) {
        case '!':
            return take(formula.ensured_hz, number(text)) && *formula.ensured_hz > 0;
        case '#':
            return take(formula.base, term(text));
        case '*':
            return take(formula.factor, number(text));
        case '/':
            return take(formula.divisor, number(text)) && formula.divisor != 0;
        case '%':
            return take(formula.cents, number(text)) && std::abs(formula.cents) <= largest_scale_cents;
        case '+':
            return take(formula.shift, term(text));
        case '~':
            return take(formula.loop, count(text));
        default:
            return false;
    }
}

/// Nothing beyond the ends of the scale.
std::optional<double> frequency_of(const FormulaTerm& term, const NoteFrequencies& scale, int note) {
    if (term.kind == FormulaTerm::Kind::Value) return term.value_hz;
    const int named = term.kind == FormulaTerm::Kind::Note ? term.notes : note + term.notes;
    if (!is_note(named)) return std::nullopt;
    return scale[static_cast<std::size_t>(named)];
}

}  // namespace

std::optional<TunFormula> read_formula(int note, std::string_view text) {
    std::string dense(text);
    std::erase_if(dense, [](char c) { return c == ' ' || c == '\t'; });
    TunFormula formula;
    formula.note = note;
    std::size_t at = 0;
    while (at < dense.size()) {
        const char operation = dense[at++];
        if (!read_operation(formula, operation, operand(dense, at))) return std::nullopt;
        if (operation == '!') break;
    }
    const bool in_scale =
        formula.base.kind != FormulaTerm::Kind::Distance || is_note(note + formula.base.notes);
    const bool shift_in_scale =
        formula.shift.kind != FormulaTerm::Kind::Distance || is_note(note + formula.shift.notes);
    return in_scale && shift_in_scale ? std::optional(formula) : std::nullopt;
}

void apply(const TunFormula& formula, NoteFrequencies& scale) {
    if (formula.ensured_hz) {
        const double ratio = *formula.ensured_hz / scale[static_cast<std::size_t>(formula.note)];
        for (double& hz : scale) hz *= ratio;
        return;
    }
    const double ratio = formula.factor / formula.divisor * std::exp2(formula.cents / cents_per_octave);
    const int step = formula.loop < 0 ? -1 : 1;
    const int last = formula.note + step * std::max(0, std::abs(formula.loop) - 1);
    for (int note = formula.note; is_note(note) && step * note <= step * last; note += step) {
        const auto base = frequency_of(formula.base, scale, note);
        const auto shift = frequency_of(formula.shift, scale, note);
        if (!base || !shift) return;
        scale[static_cast<std::size_t>(note)] = *base * ratio + *shift;
    }
}

std::array<int, midi_keys> TunMapping::each_its_own() {
    std::array<int, midi_keys> notes{};
    for (int key = 0; key < notes_of_scale; ++key) notes[static_cast<std::size_t>(key)] = key;
    return notes;
}

int TunMapping::note(int key) const {
    if (loop_size <= 0) return note_of_key[static_cast<std::size_t>(key)];
    const int raised = key / loop_size * loop_size;
    return std::clamp(note_of_key[static_cast<std::size_t>(key % loop_size)] + raised, 0, notes_of_scale - 1);
}

}  // namespace jawari::host
