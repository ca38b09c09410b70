// Two hundred malformed MIDI files in one run: each is named in one line that says what would be allowed.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/midi_bytes.h"
#include "support/run_program.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

Bytes rich_track() {
    Bytes track;
    append_event(track, 0, tempo_event(400000));
    append_event(track, 0, {0xFF, 0x03, 4, 's', 'o', 'n', 'g'});
    append_event(track, 0, {0xC0, 33});
    append_event(track, 0, {0xF0, 5, 0x7E, 0x7F, 0x09, 0x01, 0xF7});
    for (std::uint8_t key = 28; key < 44; ++key) {
        append_event(track, 200, {0x90, key, 100});
        append_event(track, 300, {0xE0, 3, 64});
        append_event(track, 0, {0x80, key, 64});
    }
    append_event(track, 0, end_of_track);
    return track;
}

/// Every file is wrong by construction.
std::vector<Bytes> malformed_files() {
    std::vector<Bytes> files;
    const Bytes whole = file_with_track(rich_track());
    for (std::size_t length = 0; length < whole.size() && files.size() < 120; ++length)
        files.emplace_back(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    const auto with_event = [&](const Bytes& event) {
        Bytes track;
        append_event(track, 0, event);
        append(track, rich_track());
        files.push_back(file_with_track(track));
    };
    for (int status = 0xF1; status <= 0xFE; ++status)  // neither channel message, exclusive nor meta
        if (status != 0xF7) with_event({static_cast<std::uint8_t>(status), 0, 0});
    for (int value = 0x80; value < 0x90; ++value) with_event({0x90, 60, static_cast<std::uint8_t>(value)});
    for (const std::uint8_t size : Bytes{0, 1, 2, 4, 5}) with_event({0xFF, 0x51, size, 1, 2, 3, 4, 5});
    for (const std::uint8_t first : Bytes{0, 1, 0x40, 0x7F})
        with_event({first, 60});  // data without a status
    with_event({0xFF, 0x51, 3, 0, 0, 0});
    with_event({0xFF, 0x03, 0xFF, 0xFF, 0xFF, 0x7F});
    with_event({0xFF, 0x03, 0xFF, 0xFF, 0xFF, 0xFF, 0x7F});
    with_event({0xF0, 0xFF, 0xFF, 0xFF, 0x7F});
    for (std::uint8_t type = 0x80; type < 0x90; ++type) with_event({0xFF, type, 0});
    for (std::uint32_t format = 2; format < 12; ++format)
        files.push_back(header_chunk(format, 1, 480)), append(files.back(), chunk("MTrk", rich_track()));
    for (std::uint32_t division : {0U, 0x8001U, 0xE700U, 0xFF28U, 0xE300U})
        files.push_back(file_with_track(rich_track(), division));
    for (std::uint32_t tracks = 2; files.size() < 200; ++tracks)
        files.push_back(header_chunk(1, tracks, 480)), append(files.back(), chunk("MTrk", rich_track()));
    files.resize(200);
    return files;
}

TEST(MalformedCorpus, EachOfTwoHundredFilesIsOneClearError) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.file("out"));
    std::vector<std::string> arguments{"render"};
    const auto files = malformed_files();
    ASSERT_EQ(files.size(), 200U);
    for (std::size_t i = 0; i < files.size(); ++i)
        arguments.push_back(
            folder.write("bad" + std::to_string(i) + ".mid", {files[i].begin(), files[i].end()}));
    const std::string good = folder.write("good.mid", [] {
        const Bytes bytes = file_with_track(rich_track());
        return std::string(bytes.begin(), bytes.end());
    }());
    arguments.insert(arguments.end(), {good, "-o", folder.file("out"), "--tail", "0", "--strict", "--quiet"});
    const Ran ran = jawari(arguments);
    EXPECT_EQ(ran.exit_code, 3);
    EXPECT_EQ(ran.error_lines(), 200);
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string name = "bad" + std::to_string(i) + ".mid: byte ";
        const std::size_t at = ran.err.find("/" + name);
        ASSERT_NE(at, std::string::npos) << name;
        const std::string line = ran.err.substr(at, ran.err.find('\n', at) - at);
        EXPECT_NE(line.find(" (allowed: "), std::string::npos) << line;
    }
    const auto made = std::filesystem::directory_iterator(folder.file("out"));
    EXPECT_EQ(std::distance(begin(made), end(made)), 1);  // the good one
}

}  // namespace
}  // namespace jawari::host
