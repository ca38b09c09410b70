// Compliant contacts against closed forms, the rigid limit and their own energy.
#include <cmath>
#include <numbers>
#include <random>

#include "laboratory/laboratory.h"
#include "string/model/compliant_law.h"

namespace jawari::laboratory {
namespace {

ContactDescription wall(const Compliance& compliance) {
    ContactDescription contact;
    contact.compliance = compliance;
    return contact;
}

/// A free mass of 0.1 kg falls at 1 m/s from 1 mm on a wall at 0.
struct Impact {
    double rebound = 0;    ///< velocity afterwards over that before
    double contact_s = 0;  ///< duration, to a row
    double deepest_m = 0;
    double imbalance = 0;  ///< of the energy, over that at the start
    double rise = 0;
};

Impact strike(const Compliance& compliance, double rate_hz) {
    StringDescription body = mass(0.1, 0, 1e-3, -1);
    body.contacts.push_back(wall(compliance));
    body.probes = {{Quantity::Displacement}, {Quantity::Velocity}, {Quantity::ContactForce}};
    const auto rows = static_cast<std::size_t>(0.01 * rate_hz);
    const Signals signals = simulate(scene_of(body, rate_hz, rate_hz), rows, Metering::Step);
    Impact impact;
    impact.rebound = -signals.probes[1].back() / signals.probes[1].front();
    for (std::size_t n = 0; n < rows; ++n) {
        if (signals.probes[2][n] > 0) impact.contact_s += 1 / rate_hz;
        impact.deepest_m = std::max(impact.deepest_m, -signals.probes[0][n]);
    }
    const EnergyMeter& meter = signals.last.energy;
    impact.imbalance = meter.worst_imbalance / meter.initial;
    impact.rise = meter.worst_rise / meter.initial;
    return impact;
}

TEST(CompliantContact, OfALinearSpringTakesHalfAPeriod) {
    const double stiffness = 1e5;
    const Impact impact = strike({stiffness, 1, 0, 0}, 4e6);
    const double omega = std::sqrt(stiffness / 0.1);
    EXPECT_NEAR(impact.contact_s, pi / omega, 1e-6);
    EXPECT_NEAR(impact.deepest_m, 1 / omega, 1e-9);
    EXPECT_NEAR(impact.rebound, 1, 1e-9);
    EXPECT_LT(impact.imbalance, 1e-13);
}

TEST(CompliantContact, OfHertzTakesAsLongAsHeSays) {
    // T = 2.9432751 s_max/v with s_max = (5 m v^2/(4 K))^(2/5) (Landau and Lifshitz, Theory of Elasticity,
    // section 9).
    const double stiffness = 1e7;
    const Impact impact = strike({stiffness, 1.5, 0, 0}, 4e6);
    const double deepest = std::pow(5 * 0.1 / (4 * stiffness), 0.4);
    EXPECT_NEAR(impact.deepest_m, deepest, 1e-6 * deepest);
    EXPECT_NEAR(impact.contact_s, 2.9432751 * deepest, 1e-6);
    EXPECT_NEAR(impact.rebound, 1, 1e-9);
}

TEST(CompliantContact, LosesWhatHuntAndCrossleysLawLoses) {
    // m v dv/((1 + beta v)) = -K s^p ds from v to -e v: (1 + e) d = ln((1 + d)/(1 - e d)), d = beta v,
    // whatever K and p.
    for (const double exponent : {1.0, 1.5, 2.5}) {
        for (const double loss : {0.1, 0.5, 2.0}) {
            const double stiffness = 1e5 * std::pow(1e-3, 1 - exponent);
            const double e = strike({stiffness, exponent, loss, 0}, 4e6).rebound;
            EXPECT_NEAR((1 + e) * loss, std::log((1 + loss) / (1 - e * loss)), 2e-3 * loss)
                << exponent << ' ' << loss;
        }
    }
}

TEST(CompliantContact, ConvergesAtSecondOrder) {
    // One mode of 1 Hz on a spring beside its rest line, in pieces of cosines: the error falls by four where
    // the rate doubles, but for the two steps at either end of each contact.
    const double stiffness = 4000;
    const auto error = [&](double rate_hz) {
        StringDescription body = mass(1, 1, 1, 0);
        body.contacts.push_back(wall({stiffness, 1, 0, 0}));
        body.probes = {{Quantity::Displacement}};
        const double omega = 2 * pi;
        const double inside = std::sqrt(omega * omega + stiffness);
        const double period = 0.5 + pi / inside;  // half of it above
        const Signals signals = simulate(scene_of(body, 1000, rate_hz), 4000);
        double worst = 0;
        for (std::size_t n = 0; n < 4000; ++n) {
            const double t = static_cast<double>(n) / 1000;
            double phase = std::fmod(t + 0.25, period);
            const double exact =
                phase < 0.5 ? std::sin(omega * phase) : -omega / inside * std::sin(inside * (phase - 0.5));
            worst = std::max(worst, std::abs(signals.probes[0][n] - exact));
        }
        return worst;
    };
    const double coarse = error(16000);
    const double fine = error(64000);
    EXPECT_LT(coarse, 5e-4);
    EXPECT_LT(fine, coarse / 6);
}

TEST(CompliantContact, OnAStringGoesToTheRigidOne) {
    // With a loss: 100 modes weigh something at a point, and a spring alone would throw that back.
    const auto displacement = [](std::optional<Compliance> compliance) {
        StringDescription string = unit_string(100);
        string.initial.shape = Pluck{0.3, 0.05};
        for (const double x : {0.2, 0.45, 0.8}) {
            ContactDescription contact{x, -0.01, 0};
            contact.compliance = compliance;
            string.contacts.push_back(contact);
        }
        string.probes = {{Quantity::Displacement, 0.37}};
        return simulate(scene_of(string, 400, 640000), 600).probes[0];
    };
    const std::vector<double> rigid = displacement(std::nullopt);
    double before = 1;
    for (const double stiffness : {1e1, 1e3, 1e5}) {
        const double difference = largest_difference(displacement(Compliance{stiffness, 1, 1000, 0}), rigid);
        EXPECT_LT(difference, 0.5 * before) << stiffness;
        before = difference;
    }
    EXPECT_LT(before, 2e-5);
}

/// Three soft points, two rigid ones, a thread above, on a string that is thrown at them.
StringDescription crowded_string(std::uint32_t seed, const Compliance& law) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    StringDescription string = unit_string(60);
    string.initial.shape = Pluck{0.1 + 0.8 * uniform(random), 0.1 * (uniform(random) - 0.3)};
    for (int i = 0; i < 6; ++i) {
        ContactDescription contact;
        contact.position_m = uniform(random);
        contact.side = i == 5 ? Side::Above : Side::Below;
        contact.height_m = (i == 5 ? 1 : -1) * 0.02 * uniform(random);
        contact.restitution = uniform(random);
        if (i % 2 == 0) contact.compliance = law;
        string.contacts.push_back(contact);
    }
    return string;
}

TEST(CompliantContact, TheEnergyBalanceClosesAndNeverRises) {
    std::uint64_t impulses = 0;
    for (const ImpactLaw law : {ImpactLaw::Signorini, ImpactLaw::Passive}) {
        for (std::uint32_t seed = 0; seed < 24; ++seed) {
            const double stiffness = std::pow(10, 1 + seed % 9);
            const Compliance compliance{stiffness, 1 + 0.5 * (seed % 4), seed % 3 == 0 ? 0.3 : 0.0,
                                        seed % 5 == 0 ? 0.1 : 0.0};
            SceneDescription scene =
                scene_of(crowded_string(seed, compliance), 200, seed % 2 == 0 ? 8000 : 64000);
            scene.law = law;
            const Signals signals = simulate(scene, 400, Metering::Step);
            const EnergyMeter& meter = signals.last.energy;
            impulses += signals.last.counters.impulses;
            EXPECT_EQ(signals.last.counters.truncated_solves, 0U) << seed;
            EXPECT_LT(meter.worst_imbalance, 1e-12 * meter.initial) << seed << ' ' << name_of(law);
            EXPECT_LT(meter.worst_rise, 1e-12 * meter.initial) << seed << ' ' << name_of(law);
            EXPECT_LT(meter.highest, meter.initial * (1 + 1e-11)) << seed;
        }
    }
    EXPECT_GT(impulses, 10000U);
}

TEST(CompliantContact, SkippingChangesNothing) {
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        StringDescription string =
            crowded_string(seed, {std::pow(10, 2 + seed % 4), 1.5, 0.1, seed % 4 == 3 ? 0.02 : 0.0});
        std::get<PhysicalModes>(string.modes).damping = DecayTimePoints{{{{0.5, 20}, {20, 5}}}};
        string.probes = {{Quantity::Displacement, 0.37}, {Quantity::Energy}};
        const SceneDescription scene = scene_of(string, 400, 16000);
        const Signals all = simulate(scene, 2000, Metering::Off, skip_all);
        const Signals nothing = simulate(scene, 2000, Metering::Off, skip_nothing);
        EXPECT_EQ(all.last.counters.impulses, nothing.last.counters.impulses) << seed;
        for (std::size_t p = 0; p < 2; ++p)
            EXPECT_LT(largest_difference(all.probes[p], nothing.probes[p]), 1e-9) << seed << ' ' << p;
        EXPECT_GT(all.last.counters.flown_frames + (seed % 4 == 3 ? 1U : 0U), 0U) << seed;
    }
}

TEST(CompliantContact, MovingItIsThePlayersWork) {
    StringDescription string = crowded_string(3, {1e3, 1, 0, 0});
    std::vector<double> height;
    for (int n = 0; n <= 200; ++n) height.push_back(-0.02 + 0.05 * std::sin(0.05 * n));
    string.contacts[0].height_m = height[0];
    string.motions.push_back({0, height});
    const Signals signals = simulate(scene_of(string, 200, 16000), 400, Metering::Step);
    const EnergyMeter& meter = signals.last.energy;
    EXPECT_GT(std::abs(meter.player_work), 1e-3 * meter.initial);
    EXPECT_LT(meter.worst_imbalance, 1e-12 * meter.highest);
    EXPECT_LT(meter.worst_rise, 1e-12 * meter.highest);
}

TEST(CompliantContact, WhatDoesNotSettleTakesNoEnergy) {
    // Points so close together and so stiff that sweeps do not settle.
    StringDescription string = unit_string(40);
    string.initial.shape = Pluck{0.5, 0.1};
    for (int i = 0; i < 60; ++i) {
        ContactDescription contact{0.3 + 1e-4 * i, -0.01, 0};
        contact.compliance = Compliance{1e12, 1, 0, 0};
        string.contacts.push_back(contact);
    }
    const Signals signals = simulate(scene_of(string, 200, 8000), 400, Metering::Step);
    EXPECT_GT(signals.last.counters.truncated_solves, 0U);
    EXPECT_LT(signals.last.energy.worst_rise, 1e-10 * signals.last.energy.initial);
}

TEST(CompliantLaw, MeanPowerIsTheDividedDifference) {
    for (const double exponent : {1.0, 1.5, 2.3, 3.0}) {
        for (const double start : {-1.0, 0.0, 1e-9, 0.3, 2.0}) {
            for (const double change : {-3.0, -0.2, -1e-7, -1e-17, 1e-17, 1e-9, 1e-3, 0.7, 40.0}) {
                const double end = start + change;
                if (end == start) continue;
                const long double degree = static_cast<long double>(exponent) + 1;
                const auto power = [&](long double s) { return s > 0 ? std::pow(s, degree) : 0.0L; };
                const long double exact = (power(end) - power(start)) / degree /
                                          (static_cast<long double>(end) - static_cast<long double>(start));
                const auto expected = static_cast<double>(exact);
                // The long double difference itself cancels where the change is small.
                const double doubt = 1e-18 * std::abs(start / change) + 4e-15;
                EXPECT_NEAR(mean_power(start, end, exponent), expected, doubt * expected + 1e-300)
                    << exponent << ' ' << start << ' ' << change;
            }
        }
    }
}

TEST(CompliantLaw, TheImpulseSatisfiesItsEquation) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < 20000; ++i) {
        const Compliance law{std::pow(10, 7 * uniform(random) + 6), 2 + uniform(random), 1 + uniform(random),
                             i % 3 == 0 ? 1 + uniform(random) : 0.0};
        const CompliantMoment moment{1e-3 * uniform(random), 1e-3 * uniform(random), 1e-5};
        const double free = moment.gap + 1e-4 * uniform(random);
        const double A = std::pow(10, 3 * uniform(random) - 1);
        const double impulse = compliant_impulse(law, moment, free, A);
        EXPECT_GE(impulse, 0);
        const double end = free + A * impulse;
        const double force = compliant_force(law, moment, end);
        // The force at the end that the impulse reaches, to the rounding of what makes it.
        const double doubt = 1e-15 * (std::abs(free) + A * impulse + std::abs(moment.gap));
        const double spread = std::max(compliant_force(law, moment, end - doubt) - force,
                                       force - compliant_force(law, moment, end + doubt));
        EXPECT_NEAR(moment.step_s * force, impulse, 1e-12 * impulse + moment.step_s * spread + 1e-300) << i;
    }
}

}  // namespace
}  // namespace jawari::laboratory
