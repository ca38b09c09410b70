#include "formats/json/parse.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace jawari::host::json {
namespace {

std::string error_of(const std::string& text) {
    const auto document = parse(text, "f.json");
    if (document) return "no error";
    EXPECT_EQ(document.error().kind, ErrorKind::InvalidInput);
    EXPECT_EQ(document.error().message.find('\n'), std::string::npos);
    return document.error().message;
}

void expect_error(const std::string& text, const std::string& start, const std::string& part = "") {
    const std::string message = error_of(text);
    EXPECT_TRUE(message.starts_with(start)) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(JsonParse, ReadsEveryKindOfValue) {
    const auto document = parse(
        R"({"a": [1, -2.5e3, 18446744073709551615], "b": {"c": null}, "d": true, "e": "x\u00e9"})", "f");
    ASSERT_TRUE(document);
    const auto& object = std::get<Object>(document.value().content);
    ASSERT_EQ(object.size(), 4U);
    const auto& numbers = std::get<Array>(find(object, "a")->content);
    EXPECT_EQ(std::get<double>(numbers[0].content), 1.0);
    EXPECT_EQ(std::get<double>(numbers[1].content), -2500.0);
    EXPECT_EQ(std::get<double>(numbers[2].content), 18446744073709551615.0);
    const auto& inner = std::get<Object>(find(object, "b")->content);
    EXPECT_TRUE(std::holds_alternative<Null>(find(inner, "c")->content));
    EXPECT_TRUE(std::get<bool>(find(object, "d")->content));
    EXPECT_EQ(std::get<std::string>(find(object, "e")->content), "x\xc3\xa9");
    EXPECT_EQ(find(object, "z"), nullptr);
}

TEST(JsonParse, SyntaxErrorsHaveLineAndColumn) {
    expect_error("{\n  \"a\": 1,\n  \"b\" 2\n}", "f.json:3:7: ", "':'");
    expect_error("{\"a\": 1", "f.json:1:", "end of input");
    expect_error("{} x", "f.json:1:4: ");
    expect_error("[1,]", "f.json:1:4: ");
    expect_error("// no\n{}", "f.json:1:");
    expect_error("{\"a\": \"\xff\"}", "f.json:1:", "UTF-8");
    expect_error("  \n ", "f.json: the file is empty");
    expect_error("", "f.json: the file is empty");
}

TEST(JsonParse, NotANumberIsSaidToBeNone) {
    for (const char* text : {"{\"a\": NaN}", "{\"a\": nan}", "{\"a\": Infinity}", "{\"a\": -Infinity}"})
        expect_error(text, "f.json:1:", "NaN and Infinity are not JSON");
    expect_error("{\"a\": 1e999}", "f.json:1:", "1e999 is too large");
}

TEST(JsonParse, DuplicateKeysAreErrorsWithTheirPath) {
    expect_error(R"({"a": 1, "a": 2})", "f.json: a: duplicate key (allowed: each key once)");
    expect_error(R"({"s": [{"x": 1}, {"x": {"y": 1, "y": 1}}]})", "f.json: s[1].x.y: duplicate key");
}

TEST(JsonParse, HostileFilesAreRefused) {
    expect_error(std::string(1000000, '['),
                 "f.json: arrays and objects are nested too deeply (allowed: 64 levels)");
    EXPECT_TRUE(parse(std::string(64, '[') + std::string(64, ']'), "f"));
    expect_error(std::string(65, '[') + std::string(65, ']'), "f.json: arrays and objects are nested");

    std::string flat = "{\"list\": [0";
    for (std::size_t i = 0; i < limits::array_items; ++i) flat += ",0";
    expect_error(flat + "]}", "f.json: list: an array that is too long (allowed: at most 65536)");

    std::string keys = "{\"k\":0";
    for (std::size_t i = 0; i < limits::object_keys; ++i) keys += ",\"" + std::to_string(i) + "\":0";
    expect_error(keys + "}", "f.json: document: too many keys (allowed: at most 1024)");

    std::string row = "[0";
    for (int i = 0; i < 60000; ++i) row += ",0";
    row += "]";
    std::string many = "[" + row;
    for (int i = 0; i < 70; ++i) many += "," + row;
    expect_error(many + "]", "f.json: the file has too many values (allowed: at most 4000000)");
}

TEST(JsonParse, LongTokensAreShortened) {
    EXPECT_LT(error_of("[" + std::string(100000, 'x') + "]").size(), 500U);
}

TEST(JsonParse, FilesAreBoundedAndUnreadableOnesReported) {
    const test::TemporaryFolder folder;
    const auto missing = parse_file(folder.file("none.json"));
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().kind, ErrorKind::File);
    EXPECT_EQ(missing.error().message, folder.file("none.json") + ": No such file or directory");
    const auto directory = parse_file(folder.file("."));
    ASSERT_FALSE(directory);
    EXPECT_EQ(directory.error().kind, ErrorKind::File);
    const auto endless = parse_file("/dev/zero");
    ASSERT_FALSE(endless);
    EXPECT_EQ(endless.error().kind, ErrorKind::InvalidInput);
    EXPECT_EQ(endless.error().message, "/dev/zero: the file is too long (allowed: at most 67108864 bytes)");
}

}  // namespace
}  // namespace jawari::host::json
