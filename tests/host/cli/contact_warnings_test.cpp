// Warnings name what occurred where, and say nothing about what did not occur.
#include "cli/contact_warnings.h"

#include <gtest/gtest.h>

#include "exit_codes.h"

namespace jawari::host {
namespace {

NamedCounters counted(const std::string& name, std::uint64_t truncated, std::uint64_t resets = 0) {
    NamedCounters part{name, {}};
    part.counters.steps = 2000;
    part.counters.solves = 450;
    part.counters.truncated_solves = truncated;
    part.counters.nonfinite_resets = resets;
    return part;
}

TEST(ContactWarnings, RunsWithoutTroubleHaveNone) {
    EXPECT_TRUE(contact_warnings("a.json", "string", {}).empty());
    EXPECT_TRUE(contact_warnings("a.json", "string", {counted("A", 0), counted("B", 0)}).empty());
}

TEST(ContactWarnings, TruncatedSolvesAreOneLineWithStringAndShare) {
    const auto lines = contact_warnings("a.json", "string", {counted("A", 0), counted("B", 13)});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(
        lines[0],
        "warning: a.json: string \"B\": 13 of 450 solves were truncated; the impulses of these steps are "
        "not those of the law");
}

TEST(ContactWarnings, OfManyStringsTheWorstAreNamed) {
    const auto lines = contact_warnings("a.json", "string",
                                        {counted("A", 1), counted("B", 4), counted("C", 0), counted("D", 2),
                                         counted("E", 3), counted("F", 2)});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(
        lines[0].starts_with("warning: a.json: string \"B\": 4 of 450 solves, string \"E\": 3 of 450 "
                             "solves, string \"D\": 2 of 450 solves and 2 more were truncated"))
        << lines[0];
}

TEST(ContactWarnings, StatesThatWereNotFiniteAreALineOfTheirOwn) {
    const auto lines = contact_warnings("a.mid", "preset", {counted("sitar", 5, 2)});
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_TRUE(
        lines[1].starts_with("warning: a.mid: preset \"sitar\": 2 of 2000 steps left a state that was "
                             "not finite"))
        << lines[1];
}

TEST(ContactWarnings, NamesCannotBreakTheLine) {
    const auto lines = contact_warnings("a\nb.json", "string", {counted("A\nB", 1)});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].find('\n'), std::string::npos) << lines[0];
}

TEST(ContactWarnings, StrictMakesThemAnErrorOfItsOwnExitCode) {
    EXPECT_FALSE(strict_error("a.json", 0));
    const MaybeError error = strict_error("a.json", 2);
    ASSERT_TRUE(error);
    EXPECT_EQ(exit_code(error->kind), 7);
    EXPECT_EQ(error->message, "a.json: 2 warnings (allowed: none, with --strict); the outputs are complete");
}

}  // namespace
}  // namespace jawari::host
