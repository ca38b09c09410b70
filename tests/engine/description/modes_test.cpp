// Modes from physics: against dispersion relations, limiting cases of each loss, definitions, and numerical
// quadrature.
#include "jawari/scene/modes.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "support/high_precision.h"

namespace jawari {
namespace {

using test::Real;

constexpr double pi = std::numbers::pi;

StringDescription bass_string() {
    StringDescription string;
    string.length_m = 0.863;
    string.linear_density_kg_per_m = 0.0067;
    PhysicalModes modes;
    modes.count = 862;
    modes.tension_N = 191.6;
    modes.inharmonicity = 3.5e-5;
    modes.inharmonicity_law = InharmonicityLaw::FirstOrder;
    modes.damping = ValetteLoss{1.14e-3, 1.8e-5, 1.2, 0.01, 3.3e-5};
    string.modes = modes;
    return string;
}

PhysicalModes& physics(StringDescription& string) {
    return std::get<PhysicalModes>(string.modes);
}

TEST(Modes, SquareRootLawIsThePinnedStiffBeamsDispersion) {
    // mu omega^2 = T beta^2 + E I beta^4 with beta = k pi/L and E I = B T L^2/pi^2.
    StringDescription string = bass_string();
    physics(string).inharmonicity_law = InharmonicityLaw::SquareRoot;
    const Modes modes = modes_of(string);
    ASSERT_EQ(modes.omega.size(), 862u);
    const Real length = string.length_m, tension = physics(string).tension_N,
               density = string.linear_density_kg_per_m;
    const Real pi_real = boost::math::constants::pi<Real>();
    const Real stiffness =
        Real(physics(string).inharmonicity) * tension * length * length / (pi_real * pi_real);
    for (std::size_t i = 0; i < modes.omega.size(); ++i) {
        const Real beta = (i + 1) * pi_real / length;
        const Real truth = sqrt((tension * beta * beta + stiffness * beta * beta * beta * beta) / density);
        EXPECT_LE(static_cast<double>(abs(Real(modes.omega[i]) - truth) / truth), 1e-15) << i + 1;
    }
}

TEST(Modes, FirstOrderLawAtValuesDoneByHand) {
    StringDescription string = bass_string();
    string.length_m = 0.5;
    string.linear_density_kg_per_m = 0.01;
    physics(string).tension_N = 100;  // c = 100 m/s, f_0 = 100 Hz
    physics(string).inharmonicity = 0.02;
    physics(string).count = 10;
    physics(string).damping = NoLoss{};
    const Modes modes = modes_of(string);
    EXPECT_NEAR(modes.omega[0] / (2 * pi), 101, 1e-12);   // 100 (1 + 0.01)
    EXPECT_NEAR(modes.omega[4] / (2 * pi), 625, 1e-12);   // 500 (1 + 0.25)
    EXPECT_NEAR(modes.omega[9] / (2 * pi), 2000, 1e-11);  // 1000 (1 + 1)
    for (const double sigma : modes.sigma) EXPECT_EQ(sigma, 0);
}

TEST(Modes, TheLawsAgreeToFirstOrder) {
    StringDescription string = bass_string();
    const Modes first_order = modes_of(string);
    physics(string).inharmonicity_law = InharmonicityLaw::SquareRoot;
    const Modes square_root = modes_of(string);
    for (std::size_t i = 0; i < 862; ++i) {
        const double stretch = 3.5e-5 * static_cast<double>((i + 1) * (i + 1));
        // sqrt(1+x) lies between 1 + x/2 - x^2/8 and 1 + x/2.
        EXPECT_LE(square_root.omega[i], first_order.omega[i] * (1 + 1e-15));
        EXPECT_GE(square_root.omega[i], first_order.omega[i] * (1 - stretch * stretch / 8 - 1e-15));
    }
}

TEST(Modes, InternalLossAloneGivesEveryModeTheSameQuality) {
    StringDescription string = bass_string();
    physics(string).damping = ValetteLoss{1.14e-3, 0, 0, 0, 1 / 3000.0};
    const Modes modes = modes_of(string);
    for (std::size_t i = 0; i < 862; ++i)
        EXPECT_NEAR(modes.omega[i] / (2 * modes.sigma[i]), 3000, 3000 * 1e-14);
}

TEST(Modes, AirAloneIsAViscousDamperOnAFlexibleString) {
    // Force R u' per length on mass mu per length: sigma = R/(2 mu). Still air of no density: R = 2 pi eta.
    // With density the boundary layer of a cylinder adds twice (mean of (2 sin)^2) that of a plane of width
    // pi d, sqrt(omega eta rho/2).
    const double eta = 1.8e-5, rho = 1.2, d = 1.14e-3, mu = 0.0067;
    StringDescription string = bass_string();
    physics(string).inharmonicity = 0;
    physics(string).damping = ValetteLoss{d, eta, 0, 0, 0};
    for (const double sigma : modes_of(string).sigma)
        EXPECT_NEAR(sigma, pi * eta / mu, 1e-14 * pi * eta / mu);

    physics(string).damping = ValetteLoss{d, eta, rho, 0, 0};
    const Modes modes = modes_of(string);
    for (std::size_t i = 0; i < 862; ++i) {
        const double boundary_layer = 2 * (pi * d) * std::sqrt(modes.omega[i] * eta * rho / 2);
        const double expected = (2 * pi * eta + boundary_layer) / (2 * mu);
        EXPECT_NEAR(modes.sigma[i], expected, 1e-14 * expected) << i + 1;
    }
}

TEST(Modes, ViscoelasticLossAloneIsAComplexBendingStiffness) {
    // E I (1 + i delta): 2 sigma omega = delta E I beta^4/mu. Valette's term is its value for weak stiffness:
    // it differs by the factor f0_k/f_k.
    const double delta = 0.01;
    StringDescription string = bass_string();
    physics(string).damping = ValetteLoss{1.14e-3, 0, 0, delta, 0};
    const Modes modes = modes_of(string);
    const double f0 = std::sqrt(191.6 / 0.0067) / (2 * 0.863);
    const double bending = 3.5e-5 * 191.6 * 0.863 * 0.863 / (pi * pi);
    for (std::size_t i = 0; i < 862; ++i) {
        const double k = static_cast<double>(i + 1);
        const double beta = k * pi / 0.863;
        const double complex_stiffness = delta * bending * std::pow(beta, 4) / 0.0067 / (2 * modes.omega[i]);
        const double stretch = modes.omega[i] / (2 * pi * k * f0);
        EXPECT_NEAR(modes.sigma[i], complex_stiffness * stretch, 1e-13 * modes.sigma[i]) << k;
    }
}

TEST(Modes, ValetteSumAtValuesDoneByHand) {
    // smooth/bass, the formula at 40 digits in bc.
    const Modes modes = modes_of(bass_string());
    const auto expect = [&](std::size_t k, double frequency_hz, double decay_per_s) {
        EXPECT_NEAR(modes.omega[k - 1] / (2 * pi), frequency_hz, 1e-14 * frequency_hz);
        EXPECT_NEAR(modes.sigma[k - 1], decay_per_s, 2e-14 * decay_per_s);
    };
    expect(1, 97.9776818241709878, 0.0622903455373785540);
    expect(100, 11512.1761512574441, 109.332971790694400);
    expect(862, 1182650.14148748473, 69124.5688762436811);
}

TEST(Modes, DecayTimePointsAreMetWhereTheyAreGiven) {
    StringDescription string = bass_string();
    string.length_m = 0.5;
    string.linear_density_kg_per_m = 0.01;
    PhysicalModes& modes = physics(string);
    modes.tension_N = 100;  // f_0 = 100 Hz
    modes.inharmonicity = 0;
    modes.count = 60;
    modes.damping = DecayTimePoints{{DecayTime{200, 12}, DecayTime{3000, 1.5}}};
    const Modes flexible = modes_of(string);
    // 60 dB down: the amplitude is 1/1000 after T60.
    EXPECT_NEAR(std::exp(-flexible.sigma[1] * 12), 1e-3, 1e-15);
    EXPECT_NEAR(std::exp(-flexible.sigma[29] * 1.5), 1e-3, 1e-15);
    for (std::size_t i = 1; i < 60; ++i) EXPECT_GT(flexible.sigma[i], flexible.sigma[i - 1]);

    for (const auto law : {InharmonicityLaw::SquareRoot, InharmonicityLaw::FirstOrder}) {
        modes.inharmonicity = 2e-4;
        modes.inharmonicity_law = law;
        modes.damping = NoLoss{};
        const Modes lossless = modes_of(string);  // puts the points at modes 3 and 41, wherever they sound
        modes.damping = DecayTimePoints{
            {DecayTime{lossless.omega[2] / (2 * pi), 9}, DecayTime{lossless.omega[40] / (2 * pi), 0.8}}};
        const Modes stiff = modes_of(string);
        EXPECT_NEAR(std::exp(-stiff.sigma[2] * 9), 1e-3, 1e-14);
        EXPECT_NEAR(std::exp(-stiff.sigma[40] * 0.8), 1e-3, 1e-14);
        // Frequency-independent loss and one growing with the square of the wave number.
        const double slope = (stiff.sigma[40] - stiff.sigma[2]) / (41 * 41 - 3 * 3);
        for (std::size_t i = 0; i < 60; ++i) {
            const double k = static_cast<double>(i + 1);
            EXPECT_NEAR(stiff.sigma[i], stiff.sigma[2] + slope * (k * k - 9), 1e-12) << k;
        }
    }
}

TEST(Modes, TablesAreTakenLiterally) {
    StringDescription string;
    string.length_m = 1;
    string.linear_density_kg_per_m = 0.01;
    string.modes = ModeTable{{440, 1000.5, 20}, {0, 3.25, 1e5}};
    const Modes modes = modes_of(string);
    ASSERT_EQ(modes.omega.size(), 3u);
    EXPECT_DOUBLE_EQ(modes.omega[0], 2764.6015351590180);
    EXPECT_DOUBLE_EQ(modes.omega[1] / modes.omega[2], 50.025);
    EXPECT_EQ(modes.sigma, (std::vector<double>{0, 3.25, 1e5}));
}

TEST(Modes, ShapesAreRightToAFewUlpAtEveryModeNumber) {
    std::mt19937_64 generator(4);
    std::uniform_real_distribution<double> uniform(0, 1);
    const Real pi_real = boost::math::constants::pi<Real>();
    for (int i = 0; i < 4000; ++i) {
        const double length = 0.2 + 2 * uniform(generator);
        const double x = i % 5 == 0 ? length * (i % 10 == 0 ? 0.5 : 0.25) : length * uniform(generator);
        const std::size_t k = 1 + static_cast<std::size_t>(uniform(generator) * 8191);
        const Real truth = sqrt(Real(2) / length) * sin(static_cast<double>(k) * pi_real * x / Real(length));
        const double ulp = 0x1p-52 * std::sqrt(2 / length);
        EXPECT_LE(static_cast<double>(abs(Real(mode_shape(k, x, length)) - truth)), 4 * ulp)
            << k << " " << x / length;
    }
}

TEST(Modes, ShapesAreOrthonormal) {
    // The trapezoidal rule on N+1 intervals integrates products of the first N sines exactly.
    const std::size_t count = 255;
    const double length = 0.863, interval = length / static_cast<double>(count + 1);
    std::vector<std::vector<double>> shape(count, std::vector<double>(count));
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t j = 0; j < count; ++j)
            shape[k][j] = mode_shape(k + 1, interval * static_cast<double>(j + 1), length);
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a; b < count; ++b) {
            double product = 0;
            for (std::size_t j = 0; j < count; ++j) product += shape[a][j] * shape[b][j] * interval;
            EXPECT_NEAR(product, a == b ? 1 : 0, 2e-14) << a + 1 << " " << b + 1;
        }
    }
}

/// Integral of f over [from, to] by Gauss-Legendre rules on `pieces` intervals.
template <class Function>
double integral(Function f, double from, double to, std::size_t pieces) {
    double sum = 0;
    const double width = (to - from) / static_cast<double>(pieces);
    for (std::size_t i = 0; i < pieces; ++i) {
        const double left = from + width * static_cast<double>(i);
        sum += boost::math::quadrature::gauss<double, 15>::integrate(f, left, left + width);
    }
    return sum;
}

TEST(Modes, PluckIsTheTrianglesProjection) {
    const double length = 0.863;
    for (const Pluck pluck : {Pluck{0.637, 0.003573}, Pluck{0.01, -0.002}, Pluck{0.4315, 0.001}}) {
        const auto triangle = [&](double x) {
            const double flank =
                x < pluck.position_m ? x / pluck.position_m : (length - x) / (length - pluck.position_m);
            return pluck.height_m * flank;
        };
        for (const std::size_t k : {1u, 2u, 3u, 7u, 50u, 431u, 862u}) {
            const auto integrand = [&](double x) { return triangle(x) * mode_shape(k, x, length); };
            const double expected = integral(integrand, 0, pluck.position_m, k) +
                                    integral(integrand, pluck.position_m, length, k);
            EXPECT_NEAR(pluck_coordinate(k, pluck, length), expected, 2e-15 * std::abs(pluck.height_m)) << k;
        }
    }
}

TEST(Modes, PluckSumsToTheTriangle) {
    // Energy (Parseval): the integral of the triangle squared is h^2 L/3; the tail after K modes falls as
    // 1/K^3.
    const double length = 0.65;
    const Pluck pluck{0.13, 0.002};
    double sum = 0, corner = 0;
    for (std::size_t k = 1; k <= 8192; ++k) {
        const double q = pluck_coordinate(k, pluck, length);
        sum += q * q;
        corner += q * mode_shape(k, pluck.position_m, length);
    }
    const double integral_of_square = pluck.height_m * pluck.height_m * length / 3;
    EXPECT_NEAR(sum, integral_of_square, 1e-9 * integral_of_square);
    // The corner is the slowest point: the sum falls short by about the tail of 1/k^2.
    EXPECT_NEAR(corner, pluck.height_m, 2e-4 * pluck.height_m);
}

}  // namespace
}  // namespace jawari
