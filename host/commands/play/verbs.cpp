#include "commands/play/verbs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/suggestion.h"
#include "base/text.h"

namespace jawari::host {

namespace {

using Kind = ArgumentKind;

constexpr ArgumentRule none{};

constexpr std::array<Verb, 14> verbs{{
    {VerbId::Preset,
     "preset",
     {{{"NAME", Kind::Preset}, none, none}},
     "plays another instrument; what sounds rings out"},
    {VerbId::Presets, "presets", {{none, none, none}}, "lists the instruments"},
    {VerbId::Set,
     "set",
     {{{"PARAMETER", Kind::Parameter}, {"VALUE", Kind::Number}, none}},
     "sets a parameter on all channels, in its unit"},
    {VerbId::Get,
     "get",
     {{{"PARAMETER", Kind::Parameter, true}, none, none}},
     "says what a parameter is (channel 1), or what all are"},
    {VerbId::Gain, "gain", {{{"DB", Kind::Number}, none, none}}, "makes everything louder or softer, in dB"},
    {VerbId::Note,
     "note",
     {{{"KEY", Kind::Key}, {"VELOCITY", Kind::Velocity}, {"SECONDS", Kind::Number}}},
     "plays a key (0 to 127, or a name: E2, F#3, Bb4) without a keyboard"},
    {VerbId::Panic, "panic", {{none, none, none}}, "ends all sound and resets controllers"},
    {VerbId::Record,
     "record",
     {{{"start|stop", Kind::StartStop},
       {"FILE.wav|FILE.mid", Kind::Path, true},
       {"FILE.mid", Kind::Path, true}}},
     "records sound, MIDI or both into new files"},
    {VerbId::Stats, "stats", {{none, none, none}}, "load, worst block, xruns, voices, energy, messages"},
    {VerbId::Monitor, "monitor", {{{"on|off", Kind::OnOff}, none, none}}, "prints MIDI messages in words"},
    {VerbId::Devices, "devices", {{none, none, none}}, "lists audio devices and MIDI inputs"},
    {VerbId::Wait,
     "wait",
     {{{"SECONDS", Kind::Number}, none, none}},
     "reads the next command later; for pipes"},
    {VerbId::Help, "help", {{{"COMMAND", Kind::VerbName, true}, none, none}}, "explains commands"},
    {VerbId::Quit, "quit", {{none, none, none}}, "ends the program"},
}};

bool is_number(Kind kind) {
    return kind == Kind::Number || kind == Kind::Velocity || kind == Kind::Key;
}

/// Names of keys as musicians write them, C4 = 60.
std::optional<double> key_number(std::string_view text) {
    constexpr std::array<int, 7> semitones{9, 11, 0, 2, 4, 5, 7};  // A to G
    if (text.empty()) return std::nullopt;
    const std::string letter = lower_case(text.substr(0, 1));
    if (letter[0] < 'a' || letter[0] > 'g') return std::nullopt;
    int key = semitones[static_cast<std::size_t>(letter[0] - 'a')];
    text.remove_prefix(1);
    for (; !text.empty() && (text[0] == '#' || text[0] == 'b'); text.remove_prefix(1))
        key += text[0] == '#' ? 1 : -1;
    const auto octave = parse_number(text);
    if (!octave || *octave != std::floor(*octave) || std::abs(*octave) > 20) return std::nullopt;
    return key + 12 * (*octave + 1);
}

std::string allowed_text(Kind kind) {
    switch (kind) {
        case Kind::Key:
            return "a key, 0 to 127 or C-1 to G9";
        case Kind::Velocity:
            return "a whole number from 1 to 127";
        case Kind::OnOff:
            return "on, off";
        case Kind::StartStop:
            return "start, stop";
        case Kind::Number:
            return "a number";
        default:
            return "a name";
    }
}

bool is_whole_between(double value, double lowest, double highest) {
    return value == std::floor(value) && value >= lowest && value <= highest;
}

std::optional<VerbValue> checked_number(const VerbValue& value, Kind kind) {
    std::optional<double> number;
    if (const auto* given = std::get_if<double>(&value)) {
        number = *given;
    } else {
        const std::string& text = std::get<std::string>(value);
        number = parse_number(text);
        if (!number && kind == Kind::Key) number = key_number(text);
    }
    if (!number || !std::isfinite(*number)) return std::nullopt;
    if (kind == Kind::Key && !is_whole_between(*number, 0, 127)) return std::nullopt;
    if (kind == Kind::Velocity && !is_whole_between(*number, 1, 127)) return std::nullopt;
    return *number;
}

/// The value as the rule wants it; nothing if it does not fit.
std::optional<VerbValue> checked(const VerbValue& value, Kind kind) {
    if (is_number(kind)) return checked_number(value, kind);
    const auto* text = std::get_if<std::string>(&value);
    if (kind == Kind::OnOff && text == nullptr) {
        const double number = std::get<double>(value);
        if (number != 0 && number != 1) return std::nullopt;
        return std::string(number == 1 ? "on" : "off");
    }
    if (text == nullptr || text->empty()) return std::nullopt;
    if (kind == Kind::OnOff && *text != "on" && *text != "off") return std::nullopt;
    if (kind == Kind::StartStop && *text != "start" && *text != "stop") return std::nullopt;
    return value;
}

std::string spelled(const VerbValue& value) {
    const auto* text = std::get_if<std::string>(&value);
    return text != nullptr ? in_quotes(*text) : shortest(std::get<double>(value));
}

}  // namespace

std::vector<std::string> verb_names() {
    std::vector<std::string> names;
    for (const Verb& verb : verbs) names.emplace_back(verb.name);
    return names;
}

std::span<const Verb> verb_table() {
    return verbs;
}

const Verb* find_verb(std::string_view name) {
    const auto found =
        std::find_if(verbs.begin(), verbs.end(), [&](const Verb& verb) { return verb.name == name; });
    return found == verbs.end() ? nullptr : &*found;
}

std::span<const ArgumentRule> arguments_of(const Verb& verb) {
    const auto is_free = [](const ArgumentRule& rule) { return rule.name.empty(); };
    const auto end = std::find_if(verb.arguments.begin(), verb.arguments.end(), is_free);
    return std::span(verb.arguments).first(static_cast<std::size_t>(end - verb.arguments.begin()));
}

std::string usage_of(const Verb& verb) {
    std::string text(verb.name);
    for (const ArgumentRule& rule : arguments_of(verb)) {
        const std::string name(rule.name);
        text += rule.optional ? " [" + name + "]" : " " + name;
    }
    return text;
}

Outcome<VerbCall> make_call(std::string_view name, const std::vector<VerbValue>& arguments) {
    const Verb* verb = find_verb(name);
    if (verb == nullptr)
        return usage_error("command", in_quotes(name) + did_you_mean(name, verb_names()), join(verb_names()));
    const auto rules = arguments_of(*verb);
    const auto required = static_cast<std::size_t>(
        std::count_if(rules.begin(), rules.end(), [](const ArgumentRule& rule) { return !rule.optional; }));
    if (arguments.size() < required || arguments.size() > rules.size())
        return usage_error(std::string(name), std::to_string(arguments.size()) + " arguments",
                           usage_of(*verb));
    VerbCall call{verb, {}};
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        auto value = checked(arguments[i], rules[i].kind);
        if (!value)
            return usage_error(std::string(name) + ": " + std::string(rules[i].name), spelled(arguments[i]),
                               allowed_text(rules[i].kind));
        call.arguments.push_back(std::move(*value));
    }
    return call;
}

Outcome<std::vector<std::string>> split_words(std::string_view line) {
    std::vector<std::string> words;
    bool in_word = false;
    bool in_quotes = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        const bool blank = c == ' ' || c == '\t' || c == '\r' || c == '\n';
        if (blank && !in_quotes) {
            in_word = false;
            continue;
        }
        if (!in_word) words.emplace_back();
        in_word = true;
        if (c == '"') {
            in_quotes = !in_quotes;
        } else if (c == '\\' && i + 1 < line.size()) {
            words.back() += line[++i];
        } else {
            words.back() += c;
        }
    }
    if (in_quotes) return Error{ErrorKind::Usage, "a double quote is left open"};
    return words;
}

Outcome<std::optional<VerbCall>> parse_line(std::string_view line) {
    const auto words = split_words(line);
    if (!words) return words.error();
    if (words.value().empty() || words.value().front().starts_with('#')) return std::optional<VerbCall>{};
    const std::vector<VerbValue> arguments(words.value().begin() + 1, words.value().end());
    auto call = make_call(words.value().front(), arguments);
    if (!call) return call.error();
    return std::optional<VerbCall>(std::move(call.value()));
}

double number_of(const VerbCall& call, std::size_t argument) {
    return std::get<double>(call.arguments[argument]);
}

const std::string& text_of(const VerbCall& call, std::size_t argument) {
    return std::get<std::string>(call.arguments[argument]);
}

}  // namespace jawari::host
