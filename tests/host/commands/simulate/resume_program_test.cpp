// `jawari simulate --save-state` and `--resume`.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/run_program.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

TEST(Resume, GoesOnWithTheSameRows) {
    const TemporaryFolder folder;
    const std::string state = folder.file("s.state");
    ASSERT_EQ(
        jawari({"simulate", "lab/bass", "--duration", "0.04", "--out", folder.file("whole.csv")}).exit_code,
        0);
    ASSERT_EQ(jawari({"simulate", "lab/bass", "--duration", "0.025", "--save-state", state}).exit_code, 0);
    const Ran second = jawari(
        {"simulate", "lab/bass", "--duration", "0.04", "--resume", state, "--out", folder.file("rest.csv")});
    ASSERT_EQ(second.exit_code, 0) << second.err;
    EXPECT_EQ(second.err, "");
    const std::string whole = read_text(folder.file("whole.csv"));
    const std::string rest = read_text(folder.file("rest.csv"));
    const std::string rows = rest.substr(rest.find('\n'));
    EXPECT_GT(std::count(rows.begin(), rows.end(), '\n'), 200);
    EXPECT_TRUE(whole.ends_with(rows));
}

TEST(Resume, AtAnotherRateSaysSo) {
    const TemporaryFolder folder;
    const std::string state = folder.file("s.state");
    ASSERT_EQ(jawari({"simulate", "lab/bass", "--duration", "0.01", "--save-state", state}).exit_code, 0);
    const Ran second = jawari({"simulate", "lab/bass", "--contact-rate", "4014080", "--resume", state,
                               "--out", folder.file("rest.h5")});
    EXPECT_EQ(second.exit_code, 0) << second.err;
    EXPECT_EQ(second.err.rfind("notice: ", 0), 0U) << second.err;
}

TEST(Resume, WhatIsWrongIsRefused) {
    const TemporaryFolder folder;
    const std::string state = folder.file("s.state");
    ASSERT_EQ(jawari({"simulate", "lab/bass", "--duration", "0.02", "--save-state", state}).exit_code, 0);
    EXPECT_EQ(jawari({"simulate", "lab/one-contact", "--resume", state}).exit_code, 3);
    EXPECT_EQ(jawari({"simulate", "lab/bass", "--duration", "0.01", "--resume", state}).exit_code, 2);
    EXPECT_EQ(jawari({"simulate", "lab/bass", "--resume", folder.write("x", "no state")}).exit_code, 3);
    EXPECT_EQ(jawari({"simulate", "lab/bass", "--resume", folder.file("none")}).exit_code, 4);
    // No state goes over another file, nor over the one that is read.
    EXPECT_EQ(jawari({"simulate", "lab/bass", "--save-state", folder.write("y.json", "{}")}).exit_code, 2);
    EXPECT_EQ(jawari({"simulate", "lab/bass", "--resume", state, "--save-state", state}).exit_code, 2);
}

}  // namespace
}  // namespace jawari::host
