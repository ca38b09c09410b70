#include "base/sound_file.h"

#include <gtest/gtest.h>
#include <sndfile.h>
#include <sys/stat.h>

#include <cmath>
#include <thread>
#include <vector>

#include "support/read_wav.h"
#include "support/temporary_folder.h"

namespace jawari::host {
namespace {

using test::TemporaryFolder;

std::vector<double> ramp(std::size_t count) {
    std::vector<double> samples(count);
    for (std::size_t i = 0; i < count; ++i) samples[i] = static_cast<double>(i) / 65536;
    return samples;
}

void write(const std::string& path, const SoundTags& tags) {
    auto file = OutputFile::create(path);
    ASSERT_TRUE(file.ok());
    auto sound = SoundFile::create(std::move(file.value()), 48000, 2, {SF_FORMAT_FLOAT, 4}, 1000, tags);
    ASSERT_TRUE(sound.ok());
    ASSERT_FALSE(sound.value().write(ramp(2000)));
    ASSERT_FALSE(sound.value().commit());
}

TEST(SoundFile, TagsAreInTheInfoListAndTheBroadcastExtension) {
    const TemporaryFolder folder;
    write(folder.file("a.wav"), {"Song", "preset x"});
    SF_INFO info{};
    SNDFILE* file = sf_open(folder.file("a.wav").c_str(), SFM_READ, &info);
    ASSERT_NE(file, nullptr);
    EXPECT_STREQ(sf_get_string(file, SF_STR_TITLE), "Song");
    EXPECT_STREQ(sf_get_string(file, SF_STR_COMMENT), "preset x");
    EXPECT_EQ(std::string(sf_get_string(file, SF_STR_SOFTWARE)).rfind("Jawari ", 0), 0U);
    SF_BROADCAST_INFO broadcast{};
    ASSERT_EQ(sf_command(file, SFC_GET_BROADCAST_INFO, &broadcast, sizeof broadcast), SF_TRUE);
    EXPECT_STREQ(broadcast.description, "Song: preset x");
    EXPECT_EQ(std::string(broadcast.origination_date, 1), std::string(1, '\0'));
    sf_close(file);
    const auto samples = test::read_wav(folder.file("a.wav")).samples();
    const auto expected = ramp(2000);
    ASSERT_EQ(samples.size(), expected.size());
    for (std::size_t i = 0; i < samples.size(); ++i) ASSERT_EQ(samples[i], expected[i]);
}

TEST(SoundFile, EqualRunsGiveEqualFiles) {
    const TemporaryFolder folder;
    write(folder.file("a.wav"), {"Song", "x"});
    write(folder.file("b.wav"), {"Song", "x"});
    EXPECT_TRUE(test::read_text(folder.file("a.wav")) == test::read_text(folder.file("b.wav")));
}

TEST(SoundFile, APipeGetsTheBytesOfTheFile) {
    const TemporaryFolder folder;
    write(folder.file("a.wav"), {"Song", "x"});
    const std::string pipe = folder.file("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::string received;
    std::thread reader([&] { received = test::read_text(pipe); });
    write(pipe, {"Song", "x"});
    reader.join();
    EXPECT_TRUE(received == test::read_text(folder.file("a.wav")));
}

}  // namespace
}  // namespace jawari::host
