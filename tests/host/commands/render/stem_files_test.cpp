#include "commands/render/stem_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "support/read_wav.h"

namespace jawari::host {
namespace {

using test::read_wav;
using test::TemporaryFolder;

const AudioFormat format{48000, SampleFormat::Float, 100, {"t", "c"}};
const std::vector<std::vector<double>> signals{{0.5, -0.25}, {0, 2}, {1, 1}};

void write(const std::string& path, const std::vector<std::string>& names) {
    FilePlan files(false);
    auto stems = StemFiles::create(path, names, format, files);
    ASSERT_TRUE(stems.ok()) << stems.error().message;
    ASSERT_FALSE(stems.value().write(signals));
    EXPECT_EQ(stems.value().clipped(), 1U);
    ASSERT_FALSE(stems.value().commit());
}

TEST(StemFiles, ChannelsOfOneFile) {
    const TemporaryFolder folder;
    write(folder.file("stems.wav"), {"a", "b", "c"});
    const auto wav = read_wav(folder.file("stems.wav"));
    EXPECT_EQ(wav.channels, 3);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(wav.channel(i), signals[i]);
}

TEST(StemFiles, AFileEach) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.file("stems"));
    write(folder.file("stems/"), {"1 bass E", "1 bass/E", "g"});
    for (const auto& [name, index] : {std::pair{"stems/1-bass-E.wav", 0U},
                                      std::pair{"stems/1-bass-E-2.wav", 1U}, std::pair{"stems/g.wav", 2U}}) {
        const auto wav = read_wav(folder.file(name));
        EXPECT_EQ(wav.channels, 1) << name;
        EXPECT_EQ(wav.samples(), signals[index]);
    }
}

TEST(StemFiles, TooManyFilesOrNoFolder) {
    const TemporaryFolder folder;
    const std::vector<std::string> many(200, "x");
    FilePlan files(false);
    const auto refused = StemFiles::create(folder.file("stems/"), many, format, files);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    EXPECT_NE(refused.error().message.find("one file for more than 128 strings, here 200"),
              std::string::npos);
    EXPECT_EQ(StemFiles::create(folder.file("none/"), {"a"}, format, files).error().kind, ErrorKind::File);
}

}  // namespace
}  // namespace jawari::host
