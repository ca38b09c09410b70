// The built files as a host's loader sees them.
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "support/run_program.h"

#ifndef JAWARI_SANITIZED

namespace jawari::host {
namespace {

/// Libraries that the loader must find.
std::set<std::string> needed_by(const std::string& file) {
    const auto ran = test::run({"/usr/bin/objdump", "-p", file});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    std::istringstream lines(ran.out);
    std::set<std::string> names;
    for (std::string word; lines >> word;)
        if (word == "NEEDED" && lines >> word) names.insert(word.substr(0, word.find(".so")));
    return names;
}

TEST(PluginFiles, NeedHighwayAndTheCxxLibraryAlone) {
    std::vector<std::string> files{JAWARI_CLAP, JAWARI_VST3};
#ifdef JAWARI_LV2
    files.emplace_back(JAWARI_LV2);
#endif
    for (const std::string& file : files) {
        std::set<std::string> needed = needed_by(file);
        EXPECT_EQ(needed.erase("libstdc++"), 1U) << file;
        EXPECT_EQ(needed.erase("libhwy"), 1U) << file;
        for (const char* of_every_program :
             {"libm", "libc", "libgcc_s", "ld-linux-x86-64", "ld-linux-aarch64"})
            needed.erase(of_every_program);
        EXPECT_EQ(needed, std::set<std::string>{}) << file;
    }
}

}  // namespace
}  // namespace jawari::host

#endif
