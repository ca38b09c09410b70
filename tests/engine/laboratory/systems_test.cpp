// Systems that are no strings: bars and plates against published numbers and closed forms.
#include "jawari/scene/systems.h"

#include <cmath>
#include <numbers>

#include "laboratory/laboratory.h"

namespace jawari::laboratory {
namespace {

constexpr std::array<BarEnd, 3> all_ends{BarEnd::Free, BarEnd::Pinned, BarEnd::Clamped};

TEST(Bar, RootsAreThePublishedOnes) {
    // R. D. Blevins, Formulas for Natural Frequency and Mode Shape, 1979, table 8-1.
    const std::vector<double> free_free{4.73004074, 7.85320462, 10.9956078, 14.1371655, 17.2787597};
    const std::vector<double> clamped_free{1.87510407, 4.69409113, 7.85475744, 10.99554073, 14.13716839};
    const std::vector<double> clamped_pinned{3.92660231, 7.06858275, 10.21017612, 13.35176878, 16.49336143};
    for (std::size_t k = 1; k <= 5; ++k) {
        EXPECT_NEAR(bar_root({BarEnd::Free, BarEnd::Free}, k), free_free[k - 1], 6e-8);
        EXPECT_NEAR(bar_root({BarEnd::Clamped, BarEnd::Clamped}, k), free_free[k - 1], 6e-8);
        EXPECT_NEAR(bar_root({BarEnd::Clamped, BarEnd::Free}, k), clamped_free[k - 1], 6e-9);
        EXPECT_NEAR(bar_root({BarEnd::Free, BarEnd::Clamped}, k), clamped_free[k - 1], 6e-9);
        EXPECT_NEAR(bar_root({BarEnd::Pinned, BarEnd::Clamped}, k), clamped_pinned[k - 1], 6e-9);
        EXPECT_NEAR(bar_root({BarEnd::Pinned, BarEnd::Free}, k), clamped_pinned[k - 1], 6e-9);
        EXPECT_DOUBLE_EQ(bar_root({BarEnd::Pinned, BarEnd::Pinned}, k), static_cast<double>(k) * pi);
    }
}

Bar bar_of(BarEnd left, BarEnd right, std::size_t count) {
    Bar bar;
    bar.length_m = 0.7;
    bar.linear_density_kg_per_m = 2;
    bar.bending_stiffness_N_m2 = 3;
    bar.ends = {left, right};
    bar.count = count;
    return bar;
}

TEST(Bar, ShapesAreOrthogonalWithMeanSquareOne) {
    constexpr std::size_t points = 4001;
    for (const BarEnd left : all_ends) {
        for (const BarEnd right : all_ends) {
            const Bar bar = bar_of(left, right, 12);
            std::vector<double> places;
            for (std::size_t i = 0; i < points; ++i)
                places.push_back(bar.length_m * static_cast<double>(i) / (points - 1));
            const ShapeTable table = bar_shapes(bar, places);
            for (std::size_t j = 0; j < bar.count; ++j) {
                for (std::size_t k = 0; k <= j; ++k) {
                    double sum = 0;  // Simpson
                    for (std::size_t i = 0; i < points; ++i) {
                        const double weight = i == 0 || i + 1 == points ? 1 : i % 2 == 1 ? 4 : 2;
                        sum += weight * table.points[i][j] * table.points[i][k];
                    }
                    EXPECT_NEAR(sum / 3 / (points - 1), j == k ? 1 : 0, 1e-7)
                        << static_cast<int>(left) << static_cast<int>(right) << ' ' << j << ' ' << k;
                }
            }
        }
    }
}

TEST(Bar, ShapesObeyTheirEndsAndTheEquation) {
    // By differences: psi'''' = beta^4 psi inside, and what each end forbids is 0 there.
    for (const BarEnd left : all_ends) {
        for (const BarEnd right : all_ends) {
            const Bar bar = bar_of(left, right, 8);
            const double d = 2e-3 * bar.length_m;
            const double L = bar.length_m;
            const std::vector<double> places{
                0,       d,           2 * d,          3 * d,           L,
                L - d,   L - 2 * d,   L - 3 * d,      0.4 * L - 2 * d, 0.4 * L - d,
                0.4 * L, 0.4 * L + d, 0.4 * L + 2 * d};
            const ShapeTable table = bar_shapes(bar, places);
            const ModeTable modes = bar_modes(bar);
            for (std::size_t k = 0; k < bar.count; ++k) {
                const auto at = [&, k](std::size_t i) { return table.points[i][k]; };
                const double beta4 = std::pow(2 * pi * modes.frequency_hz[k], 2) * 2 / 3;
                const double fourth = (at(8) - 4 * at(9) + 6 * at(10) - 4 * at(11) + at(12)) / std::pow(d, 4);
                EXPECT_NEAR(fourth, beta4 * at(10), 2e-3 * beta4 + 1e-2 / L) << k;
                const double beta = std::pow(beta4, 0.25);
                for (const auto& [end, first] :
                     {std::pair{left, std::size_t{0}}, std::pair{right, std::size_t{4}}}) {
                    const double u = at(first);
                    const double slope = (-3 * u + 4 * at(first + 1) - at(first + 2)) / (2 * d);
                    const double bend =
                        (2 * u - 5 * at(first + 1) + 4 * at(first + 2) - at(first + 3)) / (d * d);
                    if (end != BarEnd::Free) {
                        EXPECT_NEAR(u, 0, 1e-11) << k;
                    }
                    if (end == BarEnd::Clamped) {
                        EXPECT_NEAR(slope, 0, 2e-2 * beta) << k;
                    }
                    if (end != BarEnd::Clamped) {
                        EXPECT_NEAR(bend, 0, 2e-2 * beta * beta + 1e-6) << k;
                    }
                }
            }
        }
    }
}

TEST(Bar, HighModesStayFinite) {
    const Bar bar = bar_of(BarEnd::Clamped, BarEnd::Free, 3000);
    const std::vector<double> places{0, 0.35, 0.7};
    const ShapeTable table = bar_shapes(bar, places);
    for (std::size_t k = 1; k < bar.count; ++k) {
        EXPECT_NEAR(table.points[0][k], 0, 1e-12);
        EXPECT_LE(std::abs(table.points[1][k]), 1.5);
        EXPECT_NEAR(std::abs(table.points[2][k]), 2, 1e-9);  // of a cantilever's tip, all modes
    }
}

TEST(Bar, AFreeOneFliesAndTurns) {
    // A blow at an end of a free bar: its centre flies off with J/m, the bar turns with J L/(2 I), I = m
    // L^2/12.
    Bar bar = bar_of(BarEnd::Free, BarEnd::Free, 20);
    StringDescription body;
    body.modes = bar_modes(bar);
    body.shapes = bar_shapes(bar, std::vector<double>{0, 0.35, 0.7});
    body.forces.push_back({0, 0, {0, 100, 0}});  // over 2 ms: 0.1 N s
    for (const std::size_t mode : {std::size_t{1}, std::size_t{2}})
        body.probes.push_back({Quantity::ModeVelocity, 0, 0, 0, mode});
    const Signals signals = simulate(scene_of(body, 1000, 64000), 20);
    const double m = 2 * 0.7;
    EXPECT_NEAR(signals.probes[0].back(), 0.1 / m, 1e-12);
    // psi_2 = sqrt(3)(1 - 2 x/L): turning with Omega is q_2' = -Omega L/(2 sqrt 3).
    const double turning = 0.1 * 0.35 / (m * 0.7 * 0.7 / 12);
    EXPECT_NEAR(signals.probes[1].back(), turning * 0.7 / (2 * std::sqrt(3.0)), 1e-12);
}

TEST(Bar, OnItsStaticLoadBendsAsInTheHandbook) {
    // Cantilever, force P at the tip, damped out: P L^3/(3 E I) there, 5/2 of P L^3/(24 E I) in the middle.
    Bar bar = bar_of(BarEnd::Clamped, BarEnd::Free, 60);
    bar.damping = DecayTimePoints{{{{1, 1}, {1000, 1}}}};
    StringDescription body;
    body.modes = bar_modes(bar);
    body.shapes = bar_shapes(bar, std::vector<double>{0.35, 0.7});
    body.forces.push_back({0, 1, std::vector<double>(2000, 0.5)});
    body.probes = {{Quantity::Displacement, 0, 0, 0}, {Quantity::Displacement, 0, 0, 1}};
    const Signals signals = simulate(scene_of(body, 1000, 64000), 1999);
    const double unit = 0.5 * std::pow(0.7, 3) / 3;
    EXPECT_NEAR(signals.probes[1].back(), unit / 3, 1e-5 * unit);
    EXPECT_NEAR(signals.probes[0].back(), unit * 2.5 / 24, 1e-5 * unit);
}

Plate plate_of(std::size_t count) {
    Plate plate;
    plate.size_m = {0.4, 0.3};
    plate.thickness_m = 0.002;
    plate.density_kg_per_m3 = 7800;
    plate.youngs_modulus_Pa = 2e11;
    plate.poissons_ratio = 0.3;
    plate.count = count;
    return plate;
}

TEST(Plate, HasAllItsLowestModes) {
    const Plate plate = plate_of(200);
    const ModeTable modes = plate_modes(plate);
    const double D = 2e11 * 8e-9 / (12 * 0.91);
    std::vector<double> all;
    for (int m = 1; m < 200; ++m) {
        for (int n = 1; n < 200; ++n)
            all.push_back(pi / 2 * std::sqrt(D / (7800 * 0.002)) * (m * m / 0.16 + n * n / 0.09));
    }
    std::sort(all.begin(), all.end());
    for (std::size_t k = 0; k < 200; ++k) EXPECT_NEAR(modes.frequency_hz[k], all[k], 1e-9 * all[k]);
}

TEST(Plate, BendsUnderAPointLoadAsNavierSays) {
    // Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, table 23: w = alpha P a^2/D in the
    // middle under a load there, alpha = 0.01160 for a square, 0.01527 for b = 1.4 a.
    for (const auto& [ratio, alpha] :
         {std::pair{1.0, 0.01160}, std::pair{1.4, 0.01486}, std::pair{2.0, 0.01651}}) {
        Plate plate = plate_of(3000);
        plate.size_m = {0.3, 0.3 * ratio};
        plate.damping = DecayTimePoints{{{{1, 0.1}, {1000, 0.1}}}};
        StringDescription body;
        body.modes = plate_modes(plate);
        body.shapes = plate_shapes(plate, std::vector<std::array<double, 2>>{{0.15, 0.15 * ratio}});
        body.forces.push_back({0, 0, std::vector<double>(300, 10.0)});
        body.probes = {{Quantity::Displacement}};
        const Signals signals = simulate(scene_of(body, 500, 500), 299);
        const double D = 2e11 * 8e-9 / (12 * 0.91);
        EXPECT_NEAR(signals.probes[0].back(), alpha * 10 * 0.09 / D, 2e-3 * alpha * 10 * 0.09 / D) << ratio;
    }
}

TEST(Plate, BouncesOffAStopWithoutGainingEnergy) {
    Plate plate = plate_of(400);
    StringDescription body;
    body.modes = plate_modes(plate);
    body.shapes = plate_shapes(plate, std::vector<std::array<double, 2>>{{0.13, 0.11}, {0.25, 0.2}});
    std::vector<double> start(400, 0.0);
    start[0] = 1e-3;
    start[3] = -4e-4;
    body.initial.shape = ModalState{start, {}};
    ContactDescription stop;
    stop.height_m = -1e-4;
    body.contacts.push_back(stop);
    body.probes = {{Quantity::Displacement, 0, 0, 0}};
    const Signals signals = simulate(scene_of(body, 48000, 960000), 4800, Metering::Step);
    EXPECT_GT(signals.last.counters.impulses, 100U);
    for (const double u : signals.probes[0]) EXPECT_GT(u, -1e-4 - 1e-12);
    EXPECT_LT(signals.last.energy.worst_imbalance, 1e-13 * signals.last.energy.initial);
    EXPECT_LT(signals.last.energy.worst_rise, 1e-13 * signals.last.energy.initial);
}

TEST(ShapeTable, APinnedBarIsAStringOfTheSameModes) {
    StringDescription string;
    string.length_m = 0.7;
    string.linear_density_kg_per_m = 2;
    const Bar bar = bar_of(BarEnd::Pinned, BarEnd::Pinned, 40);
    string.modes = bar_modes(bar);
    StringDescription body;
    body.modes = bar_modes(bar);
    body.shapes = bar_shapes(bar, std::vector<double>{0.3, 0.5});
    std::vector<double> q(40, 0.0), shorter;
    q[0] = 0.01;
    q[1] = -0.004;
    for (const double value : q) shorter.push_back(value / std::sqrt(0.7));  // phi = psi/sqrt(L)
    string.initial.shape = ModalState{q, {}};
    body.initial.shape = ModalState{shorter, {}};
    string.contacts.push_back({0.3, -0.002, 0});
    ContactDescription contact;
    contact.height_m = -0.002;
    body.contacts.push_back(contact);
    string.probes = {{Quantity::Displacement, 0.5},
                     {Quantity::ContactForce},
                     {Quantity::Energy},
                     {Quantity::ModeEnergy, 0, 0, 0, 2}};
    body.probes = string.probes;
    body.probes[0].point = 1;
    const Signals a = simulate(scene_of(string, 1000, 100000), 1000);
    const Signals b = simulate(scene_of(body, 1000, 100000), 1000);
    EXPECT_GT(a.last.counters.impulses, 10U);
    EXPECT_LT(largest_difference(a.probes[0], b.probes[0]), 1e-9);
    EXPECT_LT(largest_difference(a.probes[2], b.probes[2]), 1e-7 * a.probes[2][0]);
    EXPECT_LT(largest_difference(a.probes[3], b.probes[3]), 1e-7 * a.probes[2][0]);
}

TEST(ShapeTable, IsRefusedWhereItIsWrong) {
    const auto place = [](StringDescription body) {
        const auto model = compile(scene_of(std::move(body), 100, 1000));
        return model ? std::string("accepted") : model.failure().place;
    };
    StringDescription body = mass(1, 0, 0, 0);
    EXPECT_EQ(place(body), "accepted");
    body.shapes->modal_mass_kg = {0};
    EXPECT_EQ(place(body), "strings[0].modes.modal_mass_kg[0]");
    body = mass(1, 0, 0, 0);
    body.shapes->points[0].push_back(1);
    EXPECT_EQ(place(body), "strings[0].modes.points[0]");
    body = mass(1, 0, 0, 0);
    body.probes = {{Quantity::BridgeForce}};
    EXPECT_EQ(place(body), "strings[0].probes[0].quantity");
    body.probes = {{Quantity::Displacement, 0, 0, 1}};
    EXPECT_EQ(place(body), "strings[0].probes[0].point");
    body = mass(1, 0, -1, 0);
    body.contacts.push_back({});
    EXPECT_EQ(place(body), "strings[0].initial");
    StringDescription string = unit_string(4);
    string.modes = ModeTable{{0, 1}, {0, 0}};
    EXPECT_EQ(place(string), "strings[0].modes.frequency_hz[0]");
}

TEST(Profile, IsProjectedAsAPluckIs) {
    StringDescription plucked = unit_string(300);
    plucked.initial.shape = Pluck{0.3, 0.02};
    StringDescription drawn = unit_string(300);
    drawn.initial.shape = Profile{{0, 0.3, 1}, {0, 0.02, 0}, {}};
    plucked.probes = drawn.probes = {{Quantity::Displacement, 0.6}};
    const Signals a = simulate(scene_of(plucked, 1000, 1000), 500);
    const Signals b = simulate(scene_of(drawn, 1000, 1000), 500);
    EXPECT_LT(largest_difference(a.probes[0], b.probes[0]), 1e-15);
}

TEST(Profile, JumpsAndVelocitiesAreProjectedExactly) {
    // A velocity of 1 between 0.2 and 0.3: v_k = sqrt 2 (cos 0.2 k pi - cos 0.3 k pi)/(k pi).
    StringDescription string = unit_string(50);
    string.initial.shape = Profile{{0.2, 0.3}, {}, {1, 1}};
    string.initial.start = Start::Backward;
    const auto model = compile(scene_of(string, 1000, 1000));
    ASSERT_TRUE(model);
    for (std::size_t k = 1; k <= 50; ++k) {
        const double wave = static_cast<double>(k) * pi;
        EXPECT_NEAR(model.value().strings[0].shape->initial_velocity[k - 1],
                    std::sqrt(2.0) * (std::cos(0.2 * wave) - std::cos(0.3 * wave)) / wave, 1e-15);
    }
}

}  // namespace
}  // namespace jawari::laboratory
