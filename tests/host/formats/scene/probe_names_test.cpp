#include "formats/scene/probe_names.h"

#include <gtest/gtest.h>

namespace jawari::host {
namespace {

std::string names(const SceneDescription& scene) {
    std::string result;
    for (const ProbeLabel& label : probe_labels(scene)) result += label.name + " ";
    return result;
}

TEST(ProbeNames, SayQuantityUnitAndPlace) {
    SceneDescription scene;
    scene.strings.resize(1);
    scene.strings[0].name = "a";
    scene.strings[0].probes = {{Quantity::Displacement, 0.0863, 0},
                               {Quantity::Velocity, 0.5, 0},
                               {Quantity::ContactForce, 0, 3},
                               {Quantity::Energy, 0, 0},
                               {Quantity::Displacement, 0.0863, 0}};
    EXPECT_EQ(names(scene),
              "displacement_m@0.0863 velocity_m_per_s@0.5 contact_force_N@contact3 energy_J "
              "displacement_m@0.0863#2 ");
}

TEST(ProbeNames, SeveralStringsAreToldApart) {
    SceneDescription scene;
    scene.strings.resize(2);
    scene.strings[0].name = "a";
    scene.strings[1].name = "b";
    for (auto& string : scene.strings) string.probes = {{Quantity::Energy, 0, 0}};
    EXPECT_EQ(names(scene), "a:energy_J b:energy_J ");
    EXPECT_EQ(probe_labels(scene)[1].string, 1U);
    scene.strings[1].name = "a";
    EXPECT_EQ(names(scene), "a:energy_J a:energy_J#2 ");
}

}  // namespace
}  // namespace jawari::host
