// The rule by which a contact rate is far too low, at values done by hand.
#include "commands/simulate/resolution_warning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formats/scene/read_scene.h"
#include "jawari/scene/compile.h"
#include "jawari/scene/modes.h"
#include "jawari/scene/resolution.h"
#include "support/scene_text.h"

namespace jawari::host {
namespace {

SceneDescription settings(ImpactLaw law, double contact_rate_hz) {
    SceneDescription description;
    description.output_rate_hz = 16000;
    description.contact_rate_hz = contact_rate_hz;
    description.law = law;
    return description;
}

/// A string that moves by 2 mm and struck something.
StringResolution struck(double penetration_m) {
    return {"A", 0.002, 98, 1.2e6, 5, penetration_m};
}

TEST(ResolutionWarning, PenetrationOfMoreThanTwoPercentIsTooMuch) {
    for (const ImpactLaw law :
         {ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::Signorini, ImpactLaw::PaoliSchatzman}) {
        EXPECT_FALSE(resolution_warning("f", settings(law, 160000), {struck(0.0199 * 0.002)}));
        EXPECT_TRUE(resolution_warning("f", settings(law, 160000), {struck(0.0201 * 0.002)}));
    }
}

/// Penetration is proportional to the step: 4 % at 160 kHz become 0.2 % at 20 times that.
TEST(ResolutionWarning, NamesTheStringAndARateThatWouldDo) {
    const auto line =
        resolution_warning("a.json", settings(ImpactLaw::Newton, 160000), {struck(0), struck(8e-5)});
    ASSERT_TRUE(line);
    EXPECT_EQ(
        *line,
        "warning: a.json: the contact rate of 160000 Hz is far too low: string \"A\" entered an obstacle "
        "by 8e-05 m, 4 % of its motion; 3200000 Hz would do");
}

TEST(ResolutionWarning, TheRateIsOneThatCompileAllows) {
    const auto line = resolution_warning("f", settings(ImpactLaw::Newton, 160000), {struck(1e9)});
    ASSERT_TRUE(line);
    EXPECT_NE(line->find("; 1000000000 Hz would do"), std::string::npos) << *line;
    SceneDescription slow = settings(ImpactLaw::Newton, 10);
    slow.output_rate_hz = 10;
    const auto slow_line = resolution_warning("f", slow, {struck(1e9)});
    ASSERT_TRUE(slow_line);
    EXPECT_NE(slow_line->find("; 655360 Hz would do"), std::string::npos) << *slow_line;
}

TEST(ResolutionWarning, StringsThatStruckNothingOrDoNotMoveHaveNone) {
    StringResolution free = struck(0.001);
    free.impulses = 0;
    StringResolution still = struck(0.001);
    still.motion_m = 0;
    EXPECT_FALSE(resolution_warning("f", settings(ImpactLaw::Newton, 16000), {free, still}));
    EXPECT_FALSE(resolution_warning("f", settings(ImpactLaw::Newton, 16000), {}));
}

/// Laws of positions enter nothing at any rate: their error is estimated, for strings with many modes.
TEST(ResolutionWarning, LawsWithoutPenetrationAreJudgedByTheEstimate) {
    const auto line = resolution_warning("f", settings(ImpactLaw::Signorini, 16000), {struck(0)});
    ASSERT_TRUE(line);
    const double enough_hz = 100 * contact_error(98, 16000) * 16000;  // for 1 %
    const double advised_hz = std::stod(line->substr(line->find("; ") + 2));
    EXPECT_GE(advised_hz, enough_hz);
    EXPECT_LT(advised_hz, enough_hz + 16000);
    EXPECT_FALSE(resolution_warning("f", settings(ImpactLaw::Newton, 16000), {struck(0)}));
    EXPECT_FALSE(resolution_warning("f", settings(ImpactLaw::Signorini, 160000), {struck(0)}));
    StringResolution few = struck(0);
    few.highest_hz = 34000;
    EXPECT_FALSE(resolution_warning("f", settings(ImpactLaw::Signorini, 16000), {few}));
}

StringResolution described(const std::string& text) {
    const SceneDescription scene = read_scene(text, "f").value().description;
    const SceneModel model = compile(scene).value();
    const SceneState state = make_state(model, Metering::Off);
    return describe_resolution(scene.strings[0], model.strings[0], state.strings[0]);
}

/// The mean square of a triangle of height a is a^2/3, that of a mode of amplitude a is a^2/2. The modes
/// above the twentieth hold a thousandth.
TEST(ResolutionWarning, TheSizeOfAPluckIsThatOfAModeOfItsMeanSquare) {
    const StringResolution string = described(test::valid_scene);
    EXPECT_NEAR(string.motion_m, 0.002 * std::sqrt(2.0 / 3), 2e-6);
    EXPECT_NEAR(string.fundamental_hz, std::sqrt(100 / 0.005) / 1.6, 1e-2);
}

/// A mode that decays by exp(-sigma h) in a step was exp(sigma h) times as large a step before.
TEST(ResolutionWarning, AStartWhoseFastModesDecayWithinAStepIsTold) {
    std::string text = test::valid_scene;
    SceneDescription scene = read_scene(text, "f").value().description;
    const Modes modes = modes_of(scene.strings[0]);
    ModeTable table;
    for (std::size_t k = 0; k < modes.omega.size(); ++k) {
        table.frequency_hz.push_back(modes.omega[k] / (2 * std::numbers::pi));
        table.decay_per_s.push_back(k == 2 ? 1e6 : 1.0);
    }
    scene.strings[0].modes = table;
    scene.scheme = Scheme::Exact;
    for (const double rate_hz : {48000.0, 2016000.0}) {
        scene.output_rate_hz = 48000;
        scene.contact_rate_hz = rate_hz;
        const SceneModel model = compile(scene).value();
        const SceneState state = make_state(model, Metering::Off);
        const auto string = describe_resolution(scene.strings[0], model.strings[0], state.strings[0]);
        EXPECT_EQ(string.fastest_decay_per_s, 1e6);
        const auto line = resolution_warning("f", scene, {string});
        EXPECT_EQ(line.has_value(), rate_hz < 1e6) << rate_hz << " " << string.energy_J;
        if (line) {
            EXPECT_TRUE(line->ends_with("; 2016000 Hz would do")) << *line;
        }
        if (rate_hz > 1e6) {
            EXPECT_NEAR(string.energy_J, string.true_energy_J, 0.1 * string.true_energy_J);
        }
    }
}

/// One mode at its rest position with the velocity v has the amplitude sqrt(2/L) v/omega.
TEST(ResolutionWarning, TheSizeOfAStringThatStartsWithAVelocityIsItsAmplitude) {
    const StringResolution string = described(R"({"schema": "jawari.scene/1", "duration_s": 0.01, "strings": [
        {"length_m": 0.5, "linear_density_kg_per_m": 0.001, "modes": {"frequency_hz": [100, 250], "decay_per_s": [0, 0]},
         "initial": {"modal_velocity": [0, 0.3]}}]})");
    EXPECT_NEAR(string.motion_m, 2 * 0.3 / (2 * std::numbers::pi * 250), 1e-12);
    EXPECT_NEAR(string.highest_hz, 250, 1e-10);
}

}  // namespace
}  // namespace jawari::host
