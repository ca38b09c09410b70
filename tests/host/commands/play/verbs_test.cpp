#include "commands/play/verbs.h"

#include <gtest/gtest.h>

#include <limits>

namespace jawari::host {
namespace {

VerbCall call_of(std::string_view line) {
    auto call = parse_line(line);
    EXPECT_TRUE(call.ok()) << line;
    EXPECT_TRUE(call.ok() && call.value()) << line;
    return call.ok() && call.value() ? *call.value() : VerbCall{};
}

std::string refusal_of(std::string_view line) {
    const auto call = parse_line(line);
    return call ? "accepted" : call.error().message;
}

TEST(Verbs, TheTableIsOneOfUniqueVerbsThatAreFound) {
    for (const Verb& verb : verb_table()) {
        EXPECT_EQ(find_verb(verb.name), &verb);
        bool optional = false;
        for (const ArgumentRule& rule : arguments_of(verb)) {
            EXPECT_TRUE(rule.optional || !optional)
                << verb.name << ": a required argument after an optional one";
            optional = rule.optional;
        }
        EXPECT_FALSE(verb.help.empty());
    }
    EXPECT_EQ(find_verb("nothing"), nullptr);
}

TEST(Verbs, LinesBecomeCalls) {
    EXPECT_EQ(call_of(" set\tpan -0.5 \r").verb->id, VerbId::Set);
    EXPECT_EQ(number_of(call_of("set pan -0.5"), 1), -0.5);
    EXPECT_EQ(text_of(call_of("preset \"my bass.json\""), 0), "my bass.json");
    EXPECT_EQ(text_of(call_of("preset my\\ bass.json"), 0), "my bass.json");
    EXPECT_EQ(text_of(call_of("record start a.wav b.mid"), 2), "b.mid");
    EXPECT_TRUE(call_of("get").arguments.empty());
    for (const char* nothing : {"", "   ", "# set pan 1"}) {
        const auto call = parse_line(nothing);
        EXPECT_TRUE(call && !call.value());
    }
}

TEST(Verbs, KeysHaveNumbersAndNames) {
    for (const auto& [name, key] : std::vector<std::pair<std::string, double>>{{"60", 60},
                                                                               {"C4", 60},
                                                                               {"E2", 40},
                                                                               {"f#3", 54},
                                                                               {"Bb4", 70},
                                                                               {"C-1", 0},
                                                                               {"G9", 127},
                                                                               {"B#3", 60},
                                                                               {"Cb4", 59}})
        EXPECT_EQ(number_of(call_of("note " + name + " 100 1"), 0), key) << name;
    for (const std::string name : {"G#9", "Cb-1", "H2", "C", "128", "60.5", "-1", "C4x", "nan"})
        EXPECT_NE(refusal_of("note " + name + " 100 1"), "accepted") << name;
}

TEST(Verbs, WhatIsWrongIsNamed) {
    EXPECT_EQ(refusal_of("note 60 0 1"), "note: VELOCITY: \"0\" (allowed: a whole number from 1 to 127)");
    EXPECT_EQ(refusal_of("set pan"), "set: 1 arguments (allowed: set PARAMETER VALUE)");
    EXPECT_EQ(refusal_of("panic now"), "panic: 1 arguments (allowed: panic)");
    EXPECT_EQ(refusal_of("monitor maybe"), "monitor: on|off: \"maybe\" (allowed: on, off)");
    EXPECT_EQ(refusal_of("preset \"\""), "preset: NAME: \"\" (allowed: a name)");
    EXPECT_EQ(refusal_of("set pan inf"), "set: VALUE: \"inf\" (allowed: a number)");
    EXPECT_EQ(refusal_of("say \"hi"), "a double quote is left open");
    EXPECT_TRUE(refusal_of("say hi").starts_with("command: \"say\" (allowed: preset, presets, "));
}

TEST(Verbs, NumbersOfOscAreNumbersAndSwitches) {
    EXPECT_EQ(number_of(make_call("set", {std::string("pan"), 0.25}).value(), 1), 0.25);
    EXPECT_EQ(text_of(make_call("monitor", {1.0}).value(), 0), "on");
    EXPECT_FALSE(make_call("monitor", {2.0}).ok());
    EXPECT_FALSE(make_call("preset", {1.0}).ok());
    EXPECT_FALSE(make_call("note", {60.0, 100.0, std::numeric_limits<double>::infinity()}).ok());
}

}  // namespace
}  // namespace jawari::host
