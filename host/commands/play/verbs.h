// What can be asked for while playing: one table for the shell, for OSC and for the help.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.h"

namespace jawari::host {

enum class VerbId {
    Preset,
    Presets,
    Set,
    Get,
    Gain,
    Note,
    Panic,
    Record,
    Stats,
    Monitor,
    Devices,
    Wait,
    Help,
    Quit
};

/// Decides what is accepted and what the shell completes.
enum class ArgumentKind { Preset, Parameter, Number, Key, Velocity, OnOff, StartStop, Path, VerbName };

struct ArgumentRule {
    std::string_view name;  ///< as the help spells it
    ArgumentKind kind = ArgumentKind::Number;
    bool optional = false;
};

inline constexpr std::size_t most_verb_arguments = 3;

struct Verb {
    VerbId id;
    std::string_view name;
    std::array<ArgumentRule, most_verb_arguments> arguments;
    std::string_view help;
};

std::span<const Verb> verb_table();

std::vector<std::string> verb_names();

/// Null if there is none of that name.
const Verb* find_verb(std::string_view name);

/// `note KEY VELOCITY SECONDS`
std::string usage_of(const Verb& verb);

/// The verb's rules, as many as it has.
std::span<const ArgumentRule> arguments_of(const Verb& verb);

/// Words are texts; OSC brings numbers as well. After make_call() each has the type that its rule asks for.
using VerbValue = std::variant<double, std::string>;

struct VerbCall {
    const Verb* verb = nullptr;
    std::vector<VerbValue> arguments;
};

/// Checks the number and the kinds of arguments; a number may come as text. Ranges are the session's affair,
/// except that every number is finite. Errors are of kind Usage.
Outcome<VerbCall> make_call(std::string_view name, const std::vector<VerbValue>& arguments);

/// Words separated by blanks; "double quotes" keep blanks, \ takes the next character as it is. Fails if a
/// quote is left open.
Outcome<std::vector<std::string>> split_words(std::string_view line);

/// A line of the shell; nothing if it is empty or a # comment.
Outcome<std::optional<VerbCall>> parse_line(std::string_view line);

/// Precondition: the argument is there and of that type.
double number_of(const VerbCall& call, std::size_t argument);
const std::string& text_of(const VerbCall& call, std::size_t argument);

}  // namespace jawari::host
