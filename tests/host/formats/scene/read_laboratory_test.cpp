// What scenes have besides strings over rigid obstacles.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formats/scene/read_scene.h"
#include "jawari/scene/compile.h"
#include "jawari/scene/render.h"

namespace jawari::host {
namespace {

std::string scene_of(const std::string& string) {
    return R"({"schema": "jawari.scene/1", "duration_s": 0.1, "output_rate_hz": 1000, "contact_rate_hz": 20000,
 "strings": [{)" +
           string + "}]}";
}

const std::string bar = R"("modes": {"bar": {"length_m": 0.5, "linear_density_kg_per_m": 0.4,
 "bending_stiffness_N_m2": 3, "ends": ["clamped", "free"], "count": 12}})";
const std::string plate = R"("modes": {"plate": {"size_m": [0.4, 0.3], "thickness_m": 0.002,
 "density_kg_per_m3": 7800, "youngs_modulus_Pa": 2e11, "poissons_ratio": 0.3, "count": 30}})";
const std::string tabled =
    R"("modes": {"frequency_hz": [0, 5], "decay_per_s": [0, 1], "modal_mass_kg": [2, 3],
 "points": [[1, 0.5], [1, -0.5]]})";
const std::string plain = R"("length_m": 0.6, "linear_density_kg_per_m": 0.005,
 "modes": {"count": 40, "tension_N": 100})";

StringDescription read(const std::string& string) {
    auto scene = read_scene(scene_of(string), "f.json");
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
    if (!scene) return {};
    const auto model = compile(scene.value().description);
    EXPECT_TRUE(model) << (model ? "" : model.failure().place + " " + model.failure().value);
    return scene.value().description.strings[0];
}

/// The message, without the file's name, of the reader or of compile().
std::string refusal(const std::string& string) {
    const auto scene = read_scene(scene_of(string), "f.json");
    if (!scene) return scene.error().message.substr(std::string("f.json: ").size());
    const auto model = compile(scene.value().description);
    return model ? "accepted" : in_file_terms(scene.value(), model.failure()).line();
}

TEST(ReadLaboratory, ABarHasAPointForEachPlace) {
    const StringDescription string = read(bar + R"(, "contacts": [{"position_m": 0.5, "height_m": -0.001}],
 "probes": [{"quantity": "displacement", "position_m": 0.25}])");
    ASSERT_TRUE(string.shapes);
    ASSERT_EQ(string.shapes->points.size(), 2U);
    EXPECT_EQ(string.contacts[0].point, 0U);
    EXPECT_EQ(string.probes[0].point, 1U);
    EXPECT_NEAR(std::abs(string.shapes->points[0][0]), 2, 1e-9);  // a cantilever's tip
    EXPECT_EQ(string.shapes->names[1], "0.25");
    EXPECT_NEAR(std::get<ModeTable>(string.modes).frequency_hz[0],
                std::pow(1.8751040687 / 0.5, 2) * std::sqrt(3 / 0.4) / (2 * std::numbers::pi), 1e-7);
}

TEST(ReadLaboratory, APlateHasPlacesInTwoDirections) {
    const StringDescription string =
        read(plate + R"(, "probes": [{"quantity": "velocity", "position_m": [0.1, 0.15]}])");
    ASSERT_EQ(string.shapes->points.size(), 1U);
    EXPECT_NEAR(string.shapes->points[0][0], std::sin(std::numbers::pi / 4), 1e-12);
    EXPECT_EQ(string.shapes->names[0], "(0.1;0.15)");
}

TEST(ReadLaboratory, TablesHaveNumberedPoints) {
    const StringDescription string = read(tabled + R"(, "contacts": [{"point": 1, "height_m": -1}],
 "probes": [{"quantity": "acceleration", "point": 0}, {"quantity": "mode_energy", "mode": 2}])");
    EXPECT_EQ(string.contacts[0].point, 1U);
    EXPECT_EQ(string.shapes->modal_mass_kg, (std::vector<double>{2, 3}));
}

TEST(ReadLaboratory, EverythingThatGivesWayArrives) {
    const StringDescription string = read(plain + R"(,
 "contacts": [{"position_m": 0.1, "height_m": -0.001,
               "compliance": {"stiffness": 1e5, "exponent": 1.5, "loss_s_per_m": 0.2, "resistance_kg_per_s": 3}}],
 "frets": {"count": 2, "height_m": -0.002, "compliance": {"stiffness": 1e6}},
 "springs": [{"position_m": 0.2, "height_m": 0.001, "stiffness_N_per_m": 50, "resistance_kg_per_s": 0.1}],
 "hammers": [{"position_m": 0.3, "side": "above", "time_s": 0.01, "mass_kg": 0.02, "velocity_m_per_s": 2,
              "stiffness": 1e8, "exponent": 2.5, "loss_s_per_m": 0.1}])");
    ASSERT_EQ(string.contacts.size(), 3U);
    EXPECT_EQ(string.contacts[0].compliance->exponent, 1.5);
    EXPECT_EQ(string.contacts[0].compliance->loss_s_per_m, 0.2);
    EXPECT_EQ(string.contacts[0].compliance->resistance_kg_per_s, 3);
    EXPECT_EQ(string.contacts[2].compliance->stiffness, 1e6);
    EXPECT_EQ(string.springs[0].height_m, 0.001);
    EXPECT_EQ(string.springs[0].stiffness_N_per_m, 50);
    EXPECT_EQ(string.springs[0].resistance_kg_per_s, 0.1);
    EXPECT_EQ(string.hammers[0].side, Side::Above);
    EXPECT_EQ(string.hammers[0].compliance.exponent, 2.5);
    EXPECT_EQ(string.hammers[0].mass_kg, 0.02);
}

TEST(ReadLaboratory, ForcesAndMotionsFollowTheirTables) {
    const StringDescription string = read(plain + R"(,
 "contacts": [{"position_m": 0.1, "motion": {"time_s": [0.01, 0.02], "height_m": [-0.004, -0.002]}}],
 "forces": [{"position_m": 0.2, "time_s": [0.002, 0.004, 0.004, 0.006], "force_N": [0, 2, 5, 1]}])");
    ASSERT_EQ(string.forces.size(), 1U);
    const std::vector<double> expected{0, 0, 0, 1, 5, 3, 1, 0};
    ASSERT_GE(string.forces[0].force_N.size(), expected.size());
    for (std::size_t n = 0; n < expected.size(); ++n)
        EXPECT_NEAR(string.forces[0].force_N[n], expected[n], 1e-12) << n;
    ASSERT_EQ(string.motions.size(), 1U);
    EXPECT_EQ(string.contacts[0].height_m, -0.004);
    EXPECT_NEAR(string.motions[0].height_m[15], -0.003, 1e-15);
    EXPECT_EQ(string.motions[0].height_m.back(), -0.002);
}

TEST(ReadLaboratory, APluckInTimePullsToItsHeightAndLetsGo) {
    auto scene = read_scene(scene_of(R"("length_m": 0.6, "linear_density_kg_per_m": 0.005,
 "modes": {"count": 40, "tension_N": 100, "damping": {"model": "t60", "points":
 [{"frequency_hz": 100, "t60_s": 0.05}, {"frequency_hz": 1000, "t60_s": 0.05}]}},
 "plucks": [{"position_m": 0.2, "time_s": 0.09, "rise_s": 0.08, "height_m": 0.003}],
 "probes": [{"quantity": "displacement", "position_m": 0.2}])"),
                            "f");
    ASSERT_TRUE(scene);
    const auto model = compile(scene.value().description);
    ASSERT_TRUE(model);
    SceneState state = make_state(model.value());
    std::vector<double> u(100);
    double* outputs[] = {u.data()};
    render(model.value(), state, outputs, 100);
    EXPECT_NEAR(u[89], 0.003 * 79 / 80, 4e-5);
    EXPECT_LT(u[93], 0.0015);
}

TEST(ReadLaboratory, AProfileArrives) {
    const StringDescription string =
        read(plain +
             R"(, "initial": {"profile": {"position_m": [0, 0.2, 0.6], "displacement_m": [0, 0.001, 0]}})");
    EXPECT_EQ(std::get<Profile>(string.initial.shape).displacement_m[1], 0.001);
}

TEST(ReadLaboratory, WhatIsWrongIsNamed) {
    EXPECT_EQ(refusal(bar + R"(, "length_m": 1)").substr(0, 33), "strings[0].length_m: unknown key ");
    EXPECT_EQ(refusal(bar + R"(, "contacts": [{"position_m": 0.6, "height_m": 0}])"),
              "strings[0].contacts[0].position_m: 0.6 (allowed: a number from 0 to 0.5)");
    EXPECT_EQ(refusal(plate + R"(, "contacts": [{"position_m": 0.2, "height_m": 0}])"),
              "strings[0].contacts[0].position_m: 0.2 (allowed: [x, y])");
    EXPECT_EQ(refusal(plate + R"(, "contacts": [{"position_m": [0.2, 0.5], "height_m": 0}])"),
              "strings[0].contacts[0].position_m[1]: 0.5 (allowed: a number from 0 to 0.3)");
    EXPECT_EQ(refusal(tabled + R"(, "contacts": [{"point": 2, "height_m": 0}])"),
              "strings[0].contacts[0].point: 2 (allowed: 0 to 1)");
    EXPECT_EQ(refusal(R"("modes": {"bar": {"length_m": 0.5, "linear_density_kg_per_m": 0.4,
 "bending_stiffness_N_m2": 3, "ends": ["held", "free"], "count": 12}})"),
              "strings[0].modes.bar.ends[0]: \"held\" (allowed: \"free\", \"pinned\", \"clamped\")");
    EXPECT_EQ(
        refusal(plain + R"(, "contacts": [{"position_m": 0.1, "height_m": 0, "compliance": {}}])"),
        "strings[0].contacts[0].compliance.stiffness: 0 (allowed: more than 0, or a resistance_kg_per_s)");
    EXPECT_EQ(refusal(plain + R"(, "plucks": [{"position_m": 0.7, "time_s": 0.01, "height_m": 0.01}])"),
              "strings[0].plucks[0].position_m: 0.7 (allowed: 0 to 0.6)");
    EXPECT_EQ(refusal(plain + R"(, "plucks": [{"position_m": 0.1, "time_s": 0.01}])"),
              "strings[0].plucks[0]: neither (allowed: one of height_m and force_N)");
    EXPECT_EQ(refusal(plain + R"(, "forces": [{"position_m": 0.1, "time_s": [0, 1], "force_N": [1]}])"),
              "strings[0].forces[0].force_N: 1 values (allowed: 2 values, as many as time_s)");
    EXPECT_EQ(refusal(plain + R"(, "forces": [{"position_m": 0.1, "time_s": [1, 0], "force_N": [1, 2]}])"),
              "strings[0].forces[0].time_s[1]: 0 (allowed: a number from 1 to 1000000000)");
    EXPECT_EQ(refusal(plain + R"(, "probes": [{"quantity": "hammer_force", "hammer": 0}])"),
              "strings[0].probes[0].hammer: 0 (allowed: a string with hammers)");
    EXPECT_EQ(
        refusal(bar + R"(, "probes": [{"quantity": "slope", "position_m": 0}])"),
        "strings[0].probes[0].quantity: slope, nut_force or bridge_force (allowed: another for what is no "
        "string)");
    EXPECT_EQ(
        refusal(bar + R"(, "initial": {"pluck": {"position_m": 0.1, "height_m": 0.1}})"),
        "strings[0].initial.pluck: a pluck (allowed: modal_displacement and modal_velocity for what is no "
        "string)");
}

TEST(LaboratoryScenes, TheBarOnItsStopSwingsAsTwoHalves) {
    // presets/scenes/lab/SOURCES.md
    const Scene scene = load_scene("lab/bar").value();
    const auto model = compile(scene.description);
    ASSERT_TRUE(model);
    SceneState state = make_state(model.value());
    std::vector<std::vector<double>> probes(4, std::vector<double>(2400));
    std::vector<double*> outputs;
    for (auto& probe : probes) outputs.push_back(probe.data());
    render(model.value(), state, outputs, 2400);
    constexpr double z = 3.926602312047919;
    const double omega = std::pow(2 * z / 0.3, 2) * std::sqrt(2e11 * 0.025 * 1e-9 / 12 / 0.19625);
    const double rest = 0.001 * (3 * 0.25 - 4 * std::pow(0.25, 3));
    const double swing = 2e-5 * (std::sin(z / 2) - std::sin(z) / std::sinh(z) * std::sinh(z / 2));
    for (std::size_t n = 0; n < 2400; ++n) {
        const double t = static_cast<double>(n) / 48000;
        EXPECT_NEAR(probes[0][n], rest + swing * std::cos(omega * t), 0.01 * swing) << n;
        EXPECT_NEAR(probes[1][n], 0.001, 1e-8) << n;
        if (n > 0) {
            EXPECT_GT(probes[2][n], 0) << n;
        }
    }
}

TEST(LaboratoryScenes, ThePlateAnswersItsHammerAsZenerSays) {
    // Before waves come back a thin plate is a resistance of 8 sqrt(D rho h) (C. Zener, Phys. Rev. 59, 1941):
    // the impulse of a hammer on a stiff felt falls off with m/Z. What the hammer loses until waves return:
    Scene scene = load_scene("lab/plate").value();
    StringDescription& string = scene.description.strings[0];
    string.contacts.clear();
    string.probes = {{Quantity::HammerForce}};
    string.hammers[0].compliance = {1e7, 1, 0, 0};
    string.hammers[0].time_s = 0;
    const auto model = compile(scene.description);
    ASSERT_TRUE(model);
    SceneState state = make_state(model.value());
    std::vector<double> force(20);
    double* outputs[] = {force.data()};
    render(model.value(), state, outputs, 20);
    // A mass m at 1 m/s, a spring K, a dashpot Z in a row: F'' + K/Z F' + K/m F = 0, F(0) = 0, F'(0) = K v.
    const double D = 2e11 * 8e-9 / (12 * 0.91);
    const double Z = 8 * std::sqrt(D * 7850 * 0.002);
    const double K = 1e7;
    const double loss = K / (2 * Z);
    const double omega = std::sqrt(K / 0.02 - loss * loss);
    double impulse = 0;
    for (std::size_t n = 1; n <= 4; ++n) impulse += force[n] / 48000;
    const double t = 4.0 / 48000;
    const double fallen = std::exp(-loss * t) * (loss * std::sin(omega * t) + omega * std::cos(omega * t));
    const double exact = K / omega * (omega - fallen) / (loss * loss + omega * omega);
    EXPECT_NEAR(impulse, exact, 0.05 * exact);
}

}  // namespace
}  // namespace jawari::host
