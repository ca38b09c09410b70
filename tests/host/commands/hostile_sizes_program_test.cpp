// Input files that never end, or are larger than the memory: refused with a line, soon and in little memory.
#include <gtest/gtest.h>

#include <unistd.h>

#include <string>
#include <vector>

#include "support/run_program.h"

namespace jawari::host {
namespace {

using namespace jawari::test;

/// Where a command reads `file`, and the other inputs are in order.
std::vector<std::vector<std::string>> readers(const TemporaryFolder& folder, const std::string& file) {
    const std::string midi = JAWARI_SOURCE_DIR "/presets/demo/slap.mid";
    const std::string out = folder.file("out.wav");
    const auto render = [&](std::vector<std::string> more) {
        std::vector<std::string> command{"render", midi, "-o", out};
        command.insert(command.end(), more.begin(), more.end());
        return command;
    };
    return {{"simulate", file},
            {"render", file, "-o", out},
            {"info", file},
            render({"--preset", file}),
            render({"--tuning", file}),
            render({"--tuning", JAWARI_SOURCE_DIR "/tests/fuzz/seeds/scale/meantone.scl", "--keyboard-map",
                    file}),
            render({"--midi-map", file})};
}

TEST(HostileSizes, EndlessFilesAreRefusedInLittleMemory) {
    const TemporaryFolder folder;
    const std::string large = folder.write("large", "{");
    ASSERT_EQ(truncate(large.c_str(), off_t{1} << 40U), 0);  // a terabyte of zeros that takes no room
    for (const std::string& file : {large, std::string("/dev/zero")}) {
        for (const auto& command : readers(folder, file)) {
            const Ran ran = jawari(command);
            EXPECT_TRUE(ran.exit_code == 3 || ran.exit_code == 4)
                << command[0] << ": " << ran.exit_code << ran.err;
            EXPECT_EQ(ran.error_lines(), 1) << ran.err;
            EXPECT_NE(ran.err.find(file), std::string::npos) << ran.err;
#ifndef JAWARI_SANITIZED
            EXPECT_LT(ran.resident_kib, 600 * 1024) << command[0] << " " << file;
#endif
        }
    }
    EXPECT_EQ(folder.names().size(), 1U);
}

#ifndef JAWARI_SANITIZED  // which need more address space than there is

/// Within every limit of the format, and far too large for the memory: 64 strings with a row of 8192 modes at
/// each of 4096 contacts.
TEST(HostileSizes, ASceneThatDoesNotFitIsOneLine) {
    const TemporaryFolder folder;
    std::string contacts;
    for (int c = 0; c < 4096; ++c)
        contacts += (c == 0 ? "" : ",") + std::string(R"({"position_m": 0.5, "height_m": -0.01})");
    const std::string string =
        R"({"length_m": 1, "linear_density_kg_per_m": 0.005, "modes": {"count": 8192, "tension_N": 100},
            "contacts": [)" +
        contacts + R"(], "probes": [{"quantity": "displacement", "position_m": 0.3}]})";
    std::string strings = string;
    for (int s = 1; s < 64; ++s) strings += "," + string;
    const std::string scene = folder.write(
        "scene.json", R"({"schema": "jawari.scene/1", "duration_s": 0.01, "strings": [)" + strings + "]}");
    const Ran ran = jawari({"simulate", scene, "--out", folder.file("out.csv")},
                           {.most_memory_bytes = std::uint64_t{400} << 20U});
    EXPECT_EQ(ran.exit_code, 5) << ran.err;
    EXPECT_EQ(ran.error_lines(), 1) << ran.err;
    EXPECT_EQ(folder.names().size(), 1U);
}

#endif

}  // namespace
}  // namespace jawari::host
