#include "base/platform.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <string>

#include "support/temporary_folder.h"

namespace jawari::host::platform {
namespace {

using namespace std::chrono_literals;
using test::TemporaryFolder;

std::string content(int file) {
    std::array<char, 64> bytes{};
    const auto count = read_some_at(file, 0, bytes);
    return {bytes.data(), static_cast<std::size_t>(std::max<std::ptrdiff_t>(count, 0))};
}

/// At the first port from the given one on that nobody has.
int open_free_port(NetworkAddress& address) {
    int opened = -1;
    for (int tries = 0; opened < 0 && tries < 1000; ++tries) {
        if (tries > 0) ++address.port;
        opened = open_datagram_socket(address);
    }
    return opened;
}

TEST(Platform, TemporaryFilesAreNewAndTheirOwnersAlone) {
    const TemporaryFolder folder;
    std::string first = folder.file("a-XXXXXX"), second = first;
    const int one = create_temporary_file(first), two = create_temporary_file(second);
    ASSERT_GE(one, 0);
    ASSERT_GE(two, 0);
    EXPECT_NE(first, second);
    EXPECT_EQ(folder.names().size(), 2U);
    EXPECT_EQ(file_facts(one)->permissions, 0600U);
    EXPECT_TRUE(set_permissions(one, 0640));
    EXPECT_EQ(file_facts(first)->permissions, 0640U);
    EXPECT_EQ(write_some(one, "four"), 4);
    EXPECT_TRUE(flush_to_disk(one));
    EXPECT_TRUE(flush_content_to_disk(one));
    EXPECT_EQ(file_facts(first)->bytes, 4U);
    EXPECT_TRUE(close_file(one));
    EXPECT_FALSE(close_file(one));
    EXPECT_EQ(errno, EBADF);
    close_file(two);
    remove_file(first.c_str());
    EXPECT_FALSE(file_facts(first));
    EXPECT_EQ(errno, ENOENT);
}

TEST(Platform, WhatIsOpenedIsNotInherited) {
    const TemporaryFolder folder;
    const std::string path = folder.file("new");
    std::string temporary = folder.file("t-XXXXXX");
    for (const int file : {create_file(path, false), create_file(path, true), open_to_read(path),
                           open_to_write(path), create_temporary_file(temporary), create_nameless_file(),
                           open_nothing(), open_datagram_socket({0x7F000001, 0})}) {
        ASSERT_GE(file, 0);
        EXPECT_NE(fcntl(file, F_GETFD) & FD_CLOEXEC, 0);
        close_file(file);
    }
    EXPECT_LT(create_file(path, false), 0);
    EXPECT_EQ(errno, EEXIST);
}

TEST(Platform, TellsKindsOfFilesApart) {
    const TemporaryFolder folder;
    EXPECT_EQ(file_facts(folder.write("file", "12345"))->kind, FileKind::Regular);
    EXPECT_EQ(file_facts(folder.file("."))->kind, FileKind::Folder);
    EXPECT_EQ(file_facts("/dev/null")->kind, FileKind::Device);
    ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
    EXPECT_EQ(file_facts(folder.file("pipe"))->kind, FileKind::Pipe);
    const int file = open_to_read(folder.file("file"));
    EXPECT_FALSE(is_terminal(file));
    EXPECT_FALSE(terminal_columns(file));
    close_file(file);
}

TEST(Platform, WritingAtAnOffsetAndRedirecting) {
    const int file = create_nameless_file(), other = create_nameless_file();
    EXPECT_EQ(write_some(file, "abcdef"), 6);
    EXPECT_EQ(write_some_at(file, 2, "XY"), 2);
    EXPECT_EQ(write_some(file, "g"), 1);
    EXPECT_EQ(content(file), "abXYefg");
    EXPECT_TRUE(redirect(other, file));
    EXPECT_EQ(write_some(other, "h"), 1);
    EXPECT_EQ(content(file), "abXYefgh");
    close_file(file);
    close_file(other);
}

TEST(Platform, OrdinaryPermissionsAreThoseOfANewFile) {
    const TemporaryFolder folder;
    close_file(create_file(folder.file("new"), false));
    EXPECT_EQ(file_facts(folder.file("new"))->permissions, ordinary_permissions());
}

TEST(Platform, WaitsForInputItsEndAndTheTime) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    std::array<Input, 2> inputs{{{ends[0]}, {-1}}};
    const auto begun = std::chrono::steady_clock::now();
    EXPECT_FALSE(wait_for_input(inputs, 20ms));
    EXPECT_GE(std::chrono::steady_clock::now() - begun, 19ms);
    EXPECT_EQ(write_some(ends[1], "x"), 1);
    EXPECT_TRUE(wait_for_input(inputs, 10s));
    EXPECT_TRUE(inputs[0].ready);
    EXPECT_FALSE(inputs[0].hung_up);
    EXPECT_FALSE(inputs[1].ready);
    char byte = 0;
    EXPECT_EQ(read_some(ends[0], {&byte, 1}), 1);
    EXPECT_EQ(byte, 'x');
    close_file(ends[1]);
    EXPECT_TRUE(wait_for_input(inputs, 10s));
    EXPECT_TRUE(inputs[0].hung_up);
    EXPECT_EQ(read_some(ends[0], {&byte, 1}), 0);
    close_file(ends[0]);
}

TEST(Platform, RunsPrograms) {
    const int nothing = open_nothing(), output = create_nameless_file(), error = create_nameless_file();
    EXPECT_TRUE(
        run_program({"sh", "-c", "echo said; echo complained >&2"}, nothing, output, error).succeeded);
    EXPECT_EQ(content(output), "said\n");
    EXPECT_EQ(content(error), "complained\n");
    const auto failed = run_program({"false"}, nothing, nothing, nothing);
    EXPECT_EQ(failed.start_error, 0);
    EXPECT_FALSE(failed.succeeded);
    EXPECT_FALSE(run_program({"sh", "-c", "kill -9 $$"}, nothing, nothing, nothing).succeeded);
    EXPECT_EQ(run_program({"no-such-program"}, nothing, nothing, nothing).start_error, ENOENT);
    for (const int file : {nothing, output, error}) close_file(file);
}

TEST(Platform, DatagramsTellTheirSender) {
    EXPECT_EQ(host_address("127.0.0.1"), 0x7F000001U);
    EXPECT_FALSE(host_address("127.0.0.256"));
    EXPECT_FALSE(host_address("localhost"));
    NetworkAddress here{0x7F000001, 20000}, there{0x7F000001, 25000};
    const int one = open_free_port(here), two = open_free_port(there);
    ASSERT_GE(one, 0);
    ASSERT_GE(two, 0);
    EXPECT_LT(open_datagram_socket(here), 0);
    EXPECT_EQ(errno, EADDRINUSE);
    std::array<char, 8> bytes{};
    NetworkAddress sender;
    EXPECT_LT(receive_datagram(two, bytes, sender), 0);
    send_datagram(one, std::string("hello"), there);
    std::array<Input, 1> input{{{two}}};
    ASSERT_TRUE(wait_for_input(input, 10s));
    EXPECT_EQ(receive_datagram(two, bytes, sender), 5);
    EXPECT_EQ(std::string(bytes.data(), 5), "hello");
    EXPECT_EQ(sender.host, here.host);
    EXPECT_EQ(sender.port, here.port);
    close_socket(one);
    close_socket(two);
}

TEST(Platform, FoldersThatAreNoPathsDoNotCount) {
    const char* old = std::getenv("XDG_DATA_DIRS");
    const std::string before = old == nullptr ? "" : old;
    setenv("XDG_DATA_DIRS", "/a/b::relative:/c:", 1);
    EXPECT_EQ(system_data_folders(), (std::vector<std::string>{"/a/b", "/c"}));
    unsetenv("XDG_DATA_DIRS");
    EXPECT_EQ(system_data_folders(), (std::vector<std::string>{"/usr/local/share", "/usr/share"}));
    if (old != nullptr) setenv("XDG_DATA_DIRS", before.c_str(), 1);
}

TEST(Platform, ATimerCanBeReadOnceAPeriod) {
    const int timer = open_timer(5ms);
    ASSERT_GE(timer, 0);
    std::array<char, 8> periods{};
    const auto begun = std::chrono::steady_clock::now();
    for (int n = 0; n < 3; ++n) {
        std::array<Input, 1> input{{{timer}}};
        ASSERT_TRUE(wait_for_input(input, 10s));
        EXPECT_EQ(read_some(timer, periods), 8);
        if (n == 0) {
            EXPECT_GE(std::chrono::steady_clock::now() - begun, 4ms);
        }
    }
    EXPECT_TRUE(close_file(timer));
    const int slow = open_timer(10min);
    EXPECT_LT(read_some(slow, periods), 0);
    EXPECT_TRUE(close_file(slow));
}

TEST(Platform, TheProcessorHasAName) {
    EXPECT_FALSE(processor_name().empty());
}

}  // namespace
}  // namespace jawari::host::platform
