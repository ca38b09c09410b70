#include "base/output_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <utility>

#include "support/temporary_folder.h"

namespace jawari::host {
namespace {

using test::read_text;
using test::TemporaryFolder;
using Names = std::vector<std::string>;

OutputFile must_create(const std::string& path) {
    auto file = OutputFile::create(path);
    if (!file) throw std::runtime_error(file.error().message);
    return std::move(file.value());
}

TEST(OutputFile, AppearsOnlyWhenCommitted) {
    const TemporaryFolder folder;
    OutputFile file = must_create(folder.file("a.csv"));
    ASSERT_FALSE(file.write("one\n"));
    ASSERT_FALSE(file.flush());
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.csv")));
    ASSERT_FALSE(file.commit());
    EXPECT_EQ(read_text(folder.file("a.csv")), "one\n");
    EXPECT_EQ(folder.names(), Names{"a.csv"});
}

TEST(OutputFile, LeavesNothingIfNotCommitted) {
    const TemporaryFolder folder;
    {
        OutputFile file = must_create(folder.file("a.csv"));
        ASSERT_FALSE(file.write("one\n"));
        OutputFile moved = std::move(file);
        ASSERT_FALSE(moved.flush());
        EXPECT_EQ(folder.names().size(), 1U);
    }
    EXPECT_TRUE(folder.names().empty());
}

TEST(OutputFile, KeepsTheOldFileUntilCommitted) {
    const TemporaryFolder folder;
    folder.write("a.csv", "old");
    { OutputFile abandoned = must_create(folder.file("a.csv")); }
    EXPECT_EQ(read_text(folder.file("a.csv")), "old");
    OutputFile file = must_create(folder.file("a.csv"));
    ASSERT_FALSE(file.write("new"));
    EXPECT_EQ(read_text(folder.file("a.csv")), "old");
    ASSERT_FALSE(file.commit());
    EXPECT_EQ(read_text(folder.file("a.csv")), "new");
}

TEST(OutputFile, LongTextIsWhole) {
    const TemporaryFolder folder;
    std::string expected;
    OutputFile file = must_create(folder.file("long"));
    for (int i = 0; i < 100000; ++i) {
        const std::string line = std::to_string(i) + "\n";
        ASSERT_FALSE(file.write(line));
        expected += line;
    }
    ASSERT_FALSE(file.commit());
    EXPECT_EQ(read_text(folder.file("long")), expected);
}

TEST(OutputFile, SymbolicLinksStayLinks) {
    const TemporaryFolder folder;
    folder.write("target", "old");
    std::filesystem::create_symlink("target", folder.file("link"));
    OutputFile file = must_create(folder.file("link"));
    ASSERT_FALSE(file.write("new"));
    ASSERT_FALSE(file.commit());
    EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
    EXPECT_EQ(read_text(folder.file("target")), "new");
}

TEST(OutputFile, ALinkToAFileThatIsNotThereYetStaysALink) {
    const TemporaryFolder folder;
    std::filesystem::create_symlink("later", folder.file("link"));
    std::filesystem::create_symlink("link", folder.file("second"));
    OutputFile file = must_create(folder.file("second"));
    ASSERT_FALSE(file.write("new"));
    ASSERT_FALSE(file.commit());
    EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
    EXPECT_EQ(read_text(folder.file("later")), "new");
}

mode_t mode_of(const std::string& path) {
    struct stat status {};
    stat(path.c_str(), &status);
    return status.st_mode & 0777U;
}

TEST(OutputFile, HasTheModeOfAnOrdinaryFileOrOfTheOldOne) {
    const TemporaryFolder folder;
    const mode_t old_mask = umask(022);
    ASSERT_FALSE(must_create(folder.file("new")).commit());
    folder.write("old", "");
    chmod(folder.file("old").c_str(), 0640);
    ASSERT_FALSE(must_create(folder.file("old")).commit());
    umask(old_mask);
    EXPECT_EQ(mode_of(folder.file("new")), 0644U);
    EXPECT_EQ(mode_of(folder.file("old")), 0640U);
}

TEST(OutputFile, UnusablePathsAreFileErrors) {
    const TemporaryFolder folder;
    folder.write("file", "");
    for (const std::string& path :
         {folder.file("no/such/folder.csv"), folder.file("file/inside.csv"), folder.file("."),
          folder.file("ends/"), std::string(), folder.file(std::string(300, 'x') + ".csv")}) {
        const auto created = OutputFile::create(path);
        ASSERT_FALSE(created) << path;
        EXPECT_EQ(created.error().kind, ErrorKind::File);
        EXPECT_TRUE(created.error().message.starts_with(path + ": ")) << created.error().message;
    }
    EXPECT_EQ(folder.names(), Names{"file"});
}

TEST(OutputFile, FullDiskIsAnError) {
    OutputFile file = must_create("/dev/full");
    EXPECT_FALSE(file.seekable());
    ASSERT_FALSE(file.write("text"));  // still in the buffer
    const auto error = file.commit();
    ASSERT_TRUE(error);
    EXPECT_EQ(error->kind, ErrorKind::File);
    EXPECT_EQ(error->message, "/dev/full: No space left on device");
}

}  // namespace
}  // namespace jawari::host
