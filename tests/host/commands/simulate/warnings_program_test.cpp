// What `jawari simulate` says of results that are not to be trusted, and what --strict makes of it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace jawari::test {
namespace {

Ran simulate(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "simulate");
    return jawari(arguments);
}

/// Obstacles that contradict each other, whatever the impulses are. The second mode turns once a step:
/// impulses cannot move it, but it drifts, down at 1/3 and up at 2/3 of the string. From the first step on,
/// the first mode, equal at both, must be above 0.2 mm for the obstacle below and under -0.2 mm for the one
/// above.
const char* const contradictory_scene =
    R"({"schema": "jawari.scene/1", "duration_s": 0.02, "output_rate_hz": 1000,
 "contact_rate_hz": 1000, "law": "signorini", "strings": [{"name": "caught", "length_m": 1,
 "linear_density_kg_per_m": 0.001, "modes": {"frequency_hz": [50, 1000], "decay_per_s": [0, 0]},
 "initial": {"modal_displacement": [0, 0], "modal_velocity": [0, -1], "start": "backward"},
 "contacts": [{"position_m": 0.3333333333333333, "height_m": -0.001, "side": "below"},
              {"position_m": 0.6666666666666666, "height_m": 0.001, "side": "above"}],
 "probes": [{"quantity": "displacement", "position_m": 0.5}]}]})";

constexpr const char* truncated = ": string \"caught\": ";

TEST(SimulateWarnings, TruncatedSolvesAreOneLineWhateverIsWritten) {
    const TemporaryFolder folder;
    const std::string scene = folder.write("s.json", contradictory_scene);
    const std::vector<std::vector<std::string>> outputs{{},
                                                        {"--out", folder.file("a.csv")},
                                                        {"--out", folder.file("a.h5")},
                                                        {"--out", folder.file("a.wav")},
                                                        {"--stats", folder.file("a.json")},
                                                        {"--plot", folder.file("a.svg")}};
    for (const auto& output : outputs) {
        std::vector<std::string> arguments{scene};
        arguments.insert(arguments.end(), output.begin(), output.end());
        const Ran ran = simulate(arguments);
        EXPECT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_EQ(ran.error_lines(), 1) << ran.err;
        EXPECT_TRUE(ran.err.starts_with("warning: " + scene + truncated)) << ran.err;
        EXPECT_NE(ran.err.find(" solves were truncated"), std::string::npos) << ran.err;
    }
    EXPECT_EQ(read_text(folder.file("a.json")).find("\"truncated_solves\": 0"), std::string::npos);
}

TEST(SimulateWarnings, StrictEndsWithItsOwnCodeAndWholeOutputs) {
    const TemporaryFolder folder;
    const std::string scene = folder.write("s.json", contradictory_scene);
    ASSERT_EQ(simulate({scene, "--out", folder.file("a.csv")}).exit_code, 0);
    const Ran ran =
        simulate({scene, "--strict", "--out", folder.file("b.csv"), "--stats", folder.file("b.json")});
    EXPECT_EQ(ran.exit_code, 7);
    EXPECT_EQ(ran.error_lines(), 2) << ran.err;
    EXPECT_TRUE(ran.err.starts_with("warning: " + scene + truncated)) << ran.err;
    EXPECT_NE(ran.err.find(scene + ": 1 warning (allowed: none, with --strict)"), std::string::npos)
        << ran.err;
    EXPECT_EQ(read_text(folder.file("a.csv")), read_text(folder.file("b.csv")));
    EXPECT_TRUE(read_text(folder.file("b.json")).ends_with("}\n"));
}

/// The displacements of a scene at 15.68 kHz over 0.1 s.
std::vector<double> displacements(const std::string& csv) {
    std::vector<double> values;
    std::stringstream lines(csv);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        std::stringstream fields(line);
        std::string field;
        std::getline(fields, field, ',');  // the time
        while (std::getline(fields, field, ',')) values.push_back(std::strtod(field.c_str(), nullptr));
    }
    return values;
}

/// Relative L2 distance.
double distance(const std::vector<double>& a, const std::vector<double>& truth) {
    EXPECT_EQ(a.size(), truth.size());
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        difference += (a[i] - truth[i]) * (a[i] - truth[i]);
        size += truth[i] * truth[i];
    }
    return std::sqrt(difference / size);
}

struct Campaign {
    const char* scene;
    const char* law;
};

/// Against the same scene at 16 MHz: who is warned is wrong by a tenth at least, who is wrong by more than 45
/// % is warned, and from 125 kHz on, the upper half of the published rates, nobody is.
class LowRates : public testing::TestWithParam<Campaign> {};

TEST_P(LowRates, AreWarnedOfWhereTheAnswerIsWrong) {
    const Campaign& campaign = GetParam();
    const auto run = [&](int steps) {
        return simulate({campaign.scene, "--law", campaign.law, "--restitution", "0", "--duration", "0.1",
                         "--output-rate", "15680", "--contact-rate", std::to_string(15680 * steps), "--out",
                         "-"});
    };
    const auto truth = displacements(run(1024).out);
    std::size_t warned = 0;
    for (const int steps : {1, 2, 4, 8, 16, 32}) {
        const Ran ran = run(steps);
        const double error = distance(displacements(ran.out), truth);
        const bool warning = ran.err.find("is far too low") != std::string::npos;
        EXPECT_EQ(ran.error_lines(), warning ? 1 : 0) << ran.err;
        EXPECT_TRUE(!warning || error > 0.1) << steps << ": " << error;
        EXPECT_TRUE(warning || error <= 0.45) << steps << ": " << error;
        EXPECT_TRUE(!warning || steps < 8) << ran.err;
        warned += warning ? 1 : 0;
    }
    EXPECT_GE(warned, 1U);
}

INSTANTIATE_TEST_SUITE_P(SimulateWarnings, LowRates,
                         testing::Values(Campaign{"lab/bass", "newton"}, Campaign{"lab/bass", "passive"},
                                         Campaign{"lab/bass", "signorini"},
                                         Campaign{"lab/one-contact", "newton"},
                                         Campaign{"lab/one-contact", "signorini"}));

/// The two-point bridge at its published 20 kHz is right to 1 %.
TEST(SimulateWarnings, ThePublishedTanpuraIsFineEnough) {
    const Ran ran = simulate({"lab/tanpura", "--out", "-"});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(ran.err, "");
}

TEST(SimulateWarnings, StrictIsSilentAboutScenesThatAreRight) {
    const Ran ran = simulate({"lab/bass", "--duration", "0.005", "--strict"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
}

}  // namespace
}  // namespace jawari::test
