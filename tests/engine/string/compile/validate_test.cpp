// Every value that a description may get wrong: refused, with its place, its text and what is allowed.
#include "string/compile/validate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "jawari/scene/compile.h"

namespace jawari {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
const double nan_value = std::nan("");

SceneDescription good_scene() {
    StringDescription string;
    string.length_m = 0.8;
    string.linear_density_kg_per_m = 0.005;
    PhysicalModes modes;
    modes.count = 10;
    modes.tension_N = 100;
    modes.inharmonicity = 1e-5;
    modes.damping = ValetteLoss{1e-3, 1.8e-5, 1.2, 0.01, 1e-4};
    string.modes = modes;
    string.initial.shape = Pluck{0.2, 1e-3};
    string.contacts = {{0.1, -1e-3, 0.5, Side::Below}, {0.3, -1e-3, 0.5, Side::Below}};
    string.probes = {
        {Quantity::Displacement, 0.4, 0}, {Quantity::ContactForce, 0, 1}, {Quantity::Energy, 0, 0}};
    SceneDescription scene;
    scene.strings = {string, string};
    return scene;
}

PhysicalModes& physical(SceneDescription& scene) {
    return std::get<PhysicalModes>(scene.strings[1].modes);
}
ValetteLoss& valette(SceneDescription& scene) {
    return std::get<ValetteLoss>(physical(scene).damping);
}
Pluck& pluck(SceneDescription& scene) {
    return std::get<Pluck>(scene.strings[1].initial.shape);
}

void use_table(SceneDescription& scene, std::vector<double> frequencies, std::vector<double> decays) {
    scene.strings[1].modes = ModeTable{std::move(frequencies), std::move(decays)};
}

struct Refusal {
    std::function<void(SceneDescription&)> spoil;
    std::string line;
};

void expect_refusals(const std::vector<Refusal>& refusals) {
    for (const Refusal& refusal : refusals) {
        SceneDescription scene = good_scene();
        refusal.spoil(scene);
        const auto result = compile(scene);
        ASSERT_FALSE(result.ok()) << "accepted; expected " << refusal.line;
        EXPECT_EQ(result.failure().line(), refusal.line);
    }
}

TEST(Validate, AcceptsWhatIsAllowed) {
    EXPECT_FALSE(validate(good_scene()).has_value());
    EXPECT_TRUE(compile(good_scene()).ok());
}

TEST(Validate, Rates) {
    const std::string range = " (allowed: 1 to 1000000000)";
    expect_refusals({
        {[](auto& s) { s.output_rate_hz = 0; }, "output_rate_hz: 0" + range},
        {[](auto& s) { s.output_rate_hz = -48000; }, "output_rate_hz: -48000" + range},
        {[](auto& s) { s.output_rate_hz = nan_value; }, "output_rate_hz: nan" + range},
        {[](auto& s) { s.output_rate_hz = infinite; }, "output_rate_hz: inf" + range},
        {[](auto& s) { s.output_rate_hz = 0.5; }, "output_rate_hz: 0.5" + range},
        {[](auto& s) { s.contact_rate_hz = 2e9; }, "contact_rate_hz: 2000000000" + range},
        {[](auto& s) { s.contact_rate_hz = nan_value; }, "contact_rate_hz: nan" + range},
        {[](auto& s) { s.contact_rate_hz = 2e6; },
         "contact_rate_hz: 2000000 (allowed: an integer multiple of output_rate_hz 48000, the nearest being "
         "2016000)"},
        {[](auto& s) { s.contact_rate_hz = 20000; },
         "contact_rate_hz: 20000 (allowed: an integer multiple of output_rate_hz 48000, the nearest being "
         "48000)"},
        {[](auto& s) {
             s.output_rate_hz = 1000;
             s.contact_rate_hz = 65537000;
         },
         "contact_rate_hz: 65537000 (allowed: at most 65536 times output_rate_hz)"},
    });
}

TEST(Validate, Schemes) {
    const auto theta = [](double value, ImpactLaw law) {
        return [=](SceneDescription& scene) {
            scene.scheme = Scheme::Theta;
            scene.theta = value;
            scene.law = law;
        };
    };
    expect_refusals({
        {theta(0.49, ImpactLaw::Newton), "theta: 0.49 (allowed: 0.5 to 1)"},
        {theta(1.01, ImpactLaw::Newton), "theta: 1.01 (allowed: 0.5 to 1)"},
        {theta(nan_value, ImpactLaw::Newton), "theta: nan (allowed: 0.5 to 1)"},
    });
    for (const ImpactLaw law : {ImpactLaw::Passive, ImpactLaw::Signorini, ImpactLaw::PaoliSchatzman}) {
        SceneDescription scene = good_scene();
        theta(0.5, law)(scene);
        const auto failure = validate(scene);
        ASSERT_TRUE(failure.has_value());
        EXPECT_EQ(failure->place, "law");
        EXPECT_EQ(failure->allowed, "newton, the only law of the theta scheme");
    }
    for (const double allowed : {0.5, 0.75, 1.0}) {
        SceneDescription scene = good_scene();
        theta(allowed, ImpactLaw::Newton)(scene);
        EXPECT_TRUE(compile(scene).ok());
    }
    SceneDescription exact = good_scene();
    exact.theta = nan_value;  // not looked at
    EXPECT_TRUE(compile(exact).ok());
}

TEST(Validate, Strings) {
    expect_refusals({
        {[](auto& s) { s.strings.clear(); }, "strings: 0 (allowed: 1 to 256)"},
        {[](auto& s) { s.strings.resize(257, s.strings[0]); }, "strings: 257 (allowed: 1 to 256)"},
        {[](auto& s) { s.strings[1].length_m = -1; }, "strings[1].length_m: -1 (allowed: 0.001 to 1000)"},
        {[](auto& s) { s.strings[0].length_m = 0; }, "strings[0].length_m: 0 (allowed: 0.001 to 1000)"},
        {[](auto& s) { s.strings[1].length_m = nan_value; },
         "strings[1].length_m: nan (allowed: 0.001 to 1000)"},
        {[](auto& s) { s.strings[1].length_m = infinite; },
         "strings[1].length_m: inf (allowed: 0.001 to 1000)"},
        {[](auto& s) { s.strings[1].linear_density_kg_per_m = 0; },
         "strings[1].linear_density_kg_per_m: 0 (allowed: a finite number > 0)"},
        {[](auto& s) { s.strings[1].linear_density_kg_per_m = infinite; },
         "strings[1].linear_density_kg_per_m: inf (allowed: a finite number > 0)"},
    });
}

TEST(Validate, PhysicalModes) {
    expect_refusals({
        {[](auto& s) { physical(s).count = 0; }, "strings[1].modes.count: 0 (allowed: 1 to 8192)"},
        {[](auto& s) { physical(s).count = 1000000000; },
         "strings[1].modes.count: 1000000000 (allowed: 1 to 8192)"},
        {[](auto& s) { physical(s).count = std::numeric_limits<std::size_t>::max(); },
         "strings[1].modes.count: 18446744073709551615 (allowed: 1 to 8192)"},
        {[](auto& s) { physical(s).tension_N = 0; },
         "strings[1].modes.tension_N: 0 (allowed: a finite number > 0)"},
        {[](auto& s) { physical(s).tension_N = nan_value; },
         "strings[1].modes.tension_N: nan (allowed: a finite number > 0)"},
        {[](auto& s) { physical(s).inharmonicity = -1e-9; },
         "strings[1].modes.inharmonicity: -1e-09 (allowed: a finite number >= 0)"},
    });
}

TEST(Validate, Losses) {
    const std::string at = "strings[1].modes.damping";
    const std::string not_negative = " (allowed: a finite number >= 0)";
    const auto points = [](DecayTime a, DecayTime b) {
        return [=](SceneDescription& scene) { physical(scene).damping = DecayTimePoints{{a, b}}; };
    };
    expect_refusals({
        {[](auto& s) { valette(s).diameter_m = 0; }, at + ".diameter_m: 0 (allowed: a finite number > 0)"},
        {[](auto& s) { valette(s).air_viscosity_Pa_s = -1; }, at + ".air_viscosity_Pa_s: -1" + not_negative},
        {[](auto& s) { valette(s).air_density_kg_per_m3 = nan_value; },
         at + ".air_density_kg_per_m3: nan" + not_negative},
        {[](auto& s) { valette(s).viscoelastic_loss_angle_rad = infinite; },
         at + ".viscoelastic_loss_angle_rad: inf" + not_negative},
        {[](auto& s) { valette(s).inverse_quality = -0.5; }, at + ".inverse_quality: -0.5" + not_negative},
        {points({0, 1}, {100, 1}), at + ".points[0].frequency_hz: 0 (allowed: a finite number > 0)"},
        {points({100, 1}, {200, 0}), at + ".points[1].t60_s: 0 (allowed: a finite number > 0)"},
        {points({100, 1}, {200, 2}),
         at + ".points: 2 (allowed: a t60_s at the higher frequency that is not longer)"},
        {points({200, 2}, {100, 1}),
         at + ".points: 2 (allowed: a t60_s at the higher frequency that is not longer)"},
        {points({100, 2}, {100, 1}), at + ".points: 100 (allowed: two different frequencies)"},
    });
}

TEST(Validate, ModeTables) {
    const std::string at = "strings[1].modes";
    expect_refusals({
        {[](auto& s) { use_table(s, {}, {}); }, at + ".frequency_hz: 0 (allowed: 1 to 8192)"},
        {[](auto& s) { use_table(s, std::vector<double>(8193, 1.0), std::vector<double>(8193, 0.0)); },
         at + ".frequency_hz: 8193 (allowed: 1 to 8192)"},
        {[](auto& s) {
             use_table(s, {100, 200}, {1});
         },
         at + ".decay_per_s: 1 values (allowed: 2 values, as many as frequency_hz)"},
        {[](auto& s) {
             use_table(s, {100, -200}, {1, 1});
         },
         at + ".frequency_hz[1]: -200 (allowed: a finite number > 0)"},
        {[](auto& s) { use_table(s, {nan_value}, {1}); },
         at + ".frequency_hz[0]: nan (allowed: a finite number > 0)"},
        {[](auto& s) {
             use_table(s, {100, 200}, {1, -1e-300});
         },
         at + ".decay_per_s[1]: -1e-300 (allowed: a finite number >= 0)"},
    });
}

TEST(Validate, InitialStates) {
    const std::string at = "strings[1].initial";
    const auto modal = [](std::vector<double> q, std::vector<double> v) {
        return [=](SceneDescription& scene) { scene.strings[1].initial.shape = ModalState{q, v}; };
    };
    expect_refusals({
        {[](auto& s) { pluck(s).height_m = nan_value; },
         at + ".pluck.height_m: nan (allowed: a finite number)"},
        {modal({1, 2, 3}, {}), at + ".modal_displacement: 3 values (allowed: 10 values, one per mode)"},
        {modal({}, std::vector<double>(11, 0.0)),
         at + ".modal_velocity: 11 values (allowed: 10 values, one per mode)"},
        {modal({0, 0, infinite, 0, 0, 0, 0, 0, 0, 0}, {}),
         at + ".modal_displacement[2]: inf (allowed: a finite number)"},
    });
    for (const double end : {0.0, 0.8, -0.1, 0.9, nan_value}) {  // a pluck lies inside the string
        SceneDescription scene = good_scene();
        pluck(scene).position_m = end;
        const auto failure = validate(scene);
        ASSERT_TRUE(failure.has_value());
        EXPECT_EQ(failure->place, at + ".pluck.position_m");
        EXPECT_EQ(failure->value, printed(end));
    }
    SceneDescription scene = good_scene();
    modal({}, {})(scene);
    EXPECT_TRUE(compile(scene).ok());
}

TEST(Validate, ContactsAndProbes) {
    const std::string at = "strings[1].contacts";
    expect_refusals({
        {[](auto& s) { s.strings[1].contacts.resize(4097); }, at + ": 4097 (allowed: 0 to 4096)"},
        {[](auto& s) { s.strings[1].contacts[1].position_m = -0.1; },
         at + "[1].position_m: -0.1 (allowed: 0 to 0.8)"},
        {[](auto& s) { s.strings[1].contacts[1].position_m = 0.81; },
         at + "[1].position_m: 0.81 (allowed: 0 to 0.8)"},
        {[](auto& s) { s.strings[1].contacts[0].position_m = nan_value; },
         at + "[0].position_m: nan (allowed: 0 to 0.8)"},
        {[](auto& s) { s.strings[1].contacts[0].height_m = -infinite; },
         at + "[0].height_m: -inf (allowed: a finite number)"},
        {[](auto& s) { s.strings[1].contacts[0].restitution = 1.1; },
         at + "[0].restitution: 1.1 (allowed: 0 to 1)"},
        {[](auto& s) { s.strings[1].contacts[0].restitution = -0.1; },
         at + "[0].restitution: -0.1 (allowed: 0 to 1)"},
        {[](auto& s) { s.strings[1].probes.resize(257); }, "strings[1].probes: 257 (allowed: 0 to 256)"},
        {[](auto& s) { s.strings[1].probes[0].position_m = 0.9; },
         "strings[1].probes[0].position_m: 0.9 (allowed: 0 to 0.8)"},
        {[](auto& s) { s.strings[1].probes[1].contact = 2; },
         "strings[1].probes[1].contact: 2 (allowed: 0 to 1)"},
        {[](auto& s) { s.strings[1].contacts.clear(); },
         "strings[1].probes[1].contact: 1 (allowed: a string with contacts)"},
    });
}

TEST(Validate, PrintsNumbersThatReadBackTheSame) {
    for (const double x : {0.1, 1.0 / 3, 1e-300, 123456789.125, -7.25, 5e-324}) {
        EXPECT_EQ(std::strtod(printed(x).c_str(), nullptr), x);
    }
    EXPECT_EQ(printed(0.1), "0.1");
    EXPECT_EQ(printed(infinite), "inf");
}

}  // namespace
}  // namespace jawari
