#include "formats/json/object_reader.h"

#include <gtest/gtest.h>

#include "formats/json/parse.h"

namespace jawari::host::json {
namespace {

Value document(const std::string& text) {
    auto parsed = parse(text, "f");
    EXPECT_TRUE(parsed) << text;
    return parsed ? std::move(parsed.value()) : Value{};
}

/// The first problem after `read` has read an object with the keys a and b.
template <class Read>
std::string problem_of(const std::string& text, Read read) {
    const Value value = document(text);
    Problems problems;
    ObjectReader reader(value, "top", {"a", "b"}, problems);
    read(reader);
    return problems.any() ? problems.first()->line() : "none";
}

const auto read_nothing = [](ObjectReader&) {};

TEST(ObjectReader, UnknownKeysListTheAllowedOnes) {
    EXPECT_EQ(problem_of(R"({"a": 1, "c": 2})", read_nothing), "top.c: unknown key (allowed: a, b)");
    EXPECT_EQ(problem_of(R"({"two\nlines": 1})", read_nothing),
              "top.two\\x0alines: unknown key (allowed: a, b)");
    EXPECT_EQ(problem_of(R"({"a": 1, "comment": "anything"})", read_nothing), "none");
    EXPECT_EQ(problem_of("[1, 2]", read_nothing), "top: an array of 2 (allowed: an object)");
}

TEST(ObjectReader, Numbers) {
    const auto in_range = [](ObjectReader& reader) { reader.number("a", {0, 1}); };
    EXPECT_EQ(problem_of(R"({"a": 0.5})", in_range), "none");
    EXPECT_EQ(problem_of(R"({"a": 2})", in_range), "top.a: 2 (allowed: a number from 0 to 1)");
    EXPECT_EQ(problem_of(R"({"a": "x"})", in_range), "top.a: \"x\" (allowed: a number from 0 to 1)");
    EXPECT_EQ(problem_of(R"({"a": null})", in_range), "top.a: null (allowed: a number from 0 to 1)");
    EXPECT_EQ(problem_of(R"({"a": [1]})", in_range), "top.a: an array of 1 (allowed: a number from 0 to 1)");
    EXPECT_EQ(problem_of("{}", in_range), "top.a: missing (allowed: a number from 0 to 1)");
    EXPECT_EQ(problem_of(R"({"a": true})", [](ObjectReader& r) { r.number("a"); }),
              "top.a: true (allowed: a finite number)");
}

TEST(ObjectReader, FallbacksOnlyForAbsentKeys) {
    const Value value = document(R"({"a": 3})");
    Problems problems;
    ObjectReader reader(value, "", {"a", "b"}, problems);
    EXPECT_EQ(reader.number_or("a", 7), 3);
    EXPECT_EQ(reader.number_or("b", 7), 7);
    EXPECT_EQ(reader.text_or("b", "word"), "word");
    EXPECT_FALSE(problems.any());
    reader.text_or("a", "word");
    EXPECT_EQ(problems.first()->line(), "a: 3 (allowed: a string)");
}

TEST(ObjectReader, WholeNumbers) {
    const auto read = [](ObjectReader& reader) { reader.whole_number("a", 1, 8); };
    EXPECT_EQ(problem_of(R"({"a": 8})", read), "none");
    EXPECT_EQ(problem_of(R"({"a": 8.0})", read), "none");
    for (const char* wrong : {"0", "9", "1.5", "-1", "1e300", "1000000000"})
        EXPECT_NE(problem_of(std::string("{\"a\": ") + wrong + "}", read)
                      .find("(allowed: a whole number from 1 to 8)"),
                  std::string::npos)
            << wrong;
}

TEST(ObjectReader, ArraysOfNumbers) {
    const auto read = [](ObjectReader& reader) { reader.numbers("a", 3); };
    EXPECT_EQ(problem_of(R"({"a": [1, 2, 3]})", read), "none");
    EXPECT_EQ(problem_of(R"({"a": [1, "2"]})", read), "top.a[1]: \"2\" (allowed: a finite number)");
    EXPECT_EQ(problem_of(R"({"a": [1, 2, 3, 4]})", read),
              "top.a: an array of 4 (allowed: an array of at most 3)");
}

TEST(ObjectReader, Choices) {
    const auto read = [](ObjectReader& reader) { reader.choice<int>("a", {{"one", 1}, {"two", 2}}); };
    EXPECT_EQ(problem_of(R"({"a": "two"})", read), "none");
    EXPECT_EQ(problem_of(R"({"a": "three"})", read), "top.a: \"three\" (allowed: \"one\", \"two\")");
    EXPECT_EQ(problem_of("{}", read), "top.a: missing (allowed: \"one\", \"two\")");
    const Value value = document(R"({"a": "two"})");
    Problems problems;
    ObjectReader reader(value, "", {"a"}, problems);
    EXPECT_EQ(reader.choice<int>("a", {{"one", 1}, {"two", 2}}), 2);
}

TEST(ObjectReader, TheFirstProblemIsKept) {
    EXPECT_EQ(problem_of(R"({"a": 2, "b": 3})",
                         [](ObjectReader& reader) {
                             reader.number("b", {0, 1});
                             reader.number("a", {0, 1});
                         }),
              "top.b: 3 (allowed: a number from 0 to 1)");
}

}  // namespace
}  // namespace jawari::host::json
