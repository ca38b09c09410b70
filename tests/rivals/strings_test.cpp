// The rivals' strings: free motion against the modes in closed form, and contact against the engine's, which
// they approach as step and compliance shrink.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "finite_difference.h"
#include "jawari/jawari.h"
#include "modal_rivals.h"

namespace jawari::rivals {
namespace {

constexpr benchmarks::Repetition once{1, 0};

SceneDescription scene(double contact_rate_hz, bool with_fret) {
    StringDescription string;
    string.length_m = 0.65;
    string.linear_density_kg_per_m = 4e-3;
    PhysicalModes modes;
    modes.count = 40;
    modes.tension_N = 80;
    modes.inharmonicity = 1e-4;
    modes.damping = DecayTimePoints{{{{100, 4.0}, {3000, 0.5}}}};
    string.modes = modes;
    string.initial.shape = Pluck{0.2, 2e-3};
    if (with_fret) string.contacts.push_back({0.4, -0.3e-3, 1, Side::Below});
    string.probes = {{Quantity::Displacement, 0.1, 0}, {Quantity::Displacement, 0.45, 0}};
    SceneDescription description;
    description.output_rate_hz = 16000;
    description.contact_rate_hz = contact_rate_hz;
    description.law = ImpactLaw::Newton;
    description.strings.push_back(string);
    return description;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference += (a[i] - b[i]) * (a[i] - b[i]);
        size += b[i] * b[i];
    }
    return std::sqrt(difference / size);
}

std::vector<double> closed_form(double duration_s) {
    const SceneDescription description = scene(16000, false);
    const StringDescription& string = description.strings[0];
    const Modes modes = modes_of(string);
    std::vector<double> samples;
    for (int n = 0; n <= std::lround(duration_s * 16000); ++n) {
        const double t = n / 16000.0;
        for (const ProbeDescription& probe : string.probes) {
            double u = 0;
            for (std::size_t k = 0; k < 40; ++k) {
                const double s = modes.sigma[k], W = std::sqrt(modes.omega[k] * modes.omega[k] - s * s);
                u += pluck_coordinate(k + 1, std::get<Pluck>(string.initial.shape), 0.65) *
                     mode_shape(k + 1, probe.position_m, 0.65) * std::exp(-s * t) *
                     (std::cos(W * t) + s / W * std::sin(W * t));
            }
            samples.push_back(u);
        }
    }
    return samples;
}

TEST(FiniteDifferenceString, FreeMotionConvergesToTheModesAtTheOrderOfItsGrid) {
    const std::vector<double> truth = closed_form(0.02);
    const double coarse = distance(run_quadratised(scene(128000, false), 0.02, {}, once).samples, truth);
    const double fine = distance(run_quadratised(scene(1024000, false), 0.02, {}, once).samples, truth);
    EXPECT_LT(fine, 3e-3);
    EXPECT_GT(std::log2(coarse / fine) / 3, 0.8)
        << coarse << " " << fine;  // stiffness ties dx to sqrt(k): first order in k
}

TEST(FiniteDifferenceString, TakesItsLossFromTheModes) {
    const SceneDescription description = scene(16000, false);
    const StiffString string = stiff_string(description.strings[0]);
    const Modes modes = modes_of(description.strings[0]);
    for (std::size_t k = 0; k < 40; ++k) {
        const double beta = static_cast<double>(k + 1) * std::numbers::pi / 0.65;
        EXPECT_NEAR(string.loss + string.loss_curve * beta * beta, modes.sigma[k], 1e-9 * modes.sigma[k]);
        const double omega2 =
            std::pow(string.wave_speed * beta, 2) + std::pow(string.stiffness * beta * beta, 2);
        EXPECT_NEAR(std::sqrt(omega2), modes.omega[k], 1e-9 * modes.omega[k]);
    }
}

std::vector<double> engine_samples(double contact_rate_hz, double duration_s) {
    const auto compiled = compile(scene(contact_rate_hz, true));
    const SceneModel& model = compiled.value();
    SceneState state = make_state(model);
    const auto rows = static_cast<std::size_t>(std::lround(duration_s * 16000)) + 1;
    std::vector<double> first(rows), second(rows), samples;
    std::vector<double*> outputs{first.data(), second.data()};
    render(model, state, outputs, rows);
    for (std::size_t n = 0; n < rows; ++n) {
        samples.push_back(first[n]);
        samples.push_back(second[n]);
    }
    return samples;
}

// Three methods, one string: as the rate grows and with it the stiffness, all approach the rigid,
// lossless contact.
TEST(ModalRivals, ApproachTheRigidContact) {
    const std::vector<double> rigid = engine_samples(16384000, 0.02);
    const auto penalty = [&](double rate) {
        return distance(run_penalty(scene(rate, true), 0.02, {30, 1, 1}, once).samples, rigid);
    };
    const auto quadratised = [&](double rate) {
        return distance(run_quadratised_modal(scene(rate, true), 0.02, {1, 1, 1}, once).samples, rigid);
    };
    EXPECT_LT(penalty(4096000), 0.01) << penalty(256000) << " " << penalty(1024000);
    EXPECT_LT(quadratised(4096000), 0.02) << quadratised(256000) << " " << quadratised(1024000);
    EXPECT_LT(penalty(4096000), penalty(256000) / 2);
    EXPECT_LT(quadratised(4096000), quadratised(256000) / 4);
}

}  // namespace
}  // namespace jawari::rivals
