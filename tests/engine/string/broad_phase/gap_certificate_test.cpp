// The inequalities of docs/engine/certificate.md on random modes, against free stepping in long double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "instrument/touch/touches.h"
#include "jawari/detail/step_coefficients.h"
#include "jawari/scene/energy.h"
#include "jawari/scene/render.h"
#include "string/broad_phase/gap_bounds.h"
#include "string/frame/frame.h"
#include "string/kernels/flight.h"
#include "string/kernels/mode_bounds.h"
#include "string/state/excitation.h"
#include "support/multiprecision.h"
#include "support/scenes.h"

namespace jawari {
namespace {

/// One mode as a string model, at any frequency, loss and rate.
StringModel one_mode(double frequency_hz, double decay_per_s, double rate_hz, std::size_t steps_per_frame) {
    SceneDescription scene;
    scene.contact_rate_hz = rate_hz;
    scene.output_rate_hz = rate_hz / static_cast<double>(steps_per_frame);
    StringDescription string;
    string.length_m = 1;
    string.linear_density_kg_per_m = 0.01;
    string.modes = ModeTable{{frequency_hz}, {decay_per_s}};
    scene.strings.push_back(string);
    return test::compiled_string(scene);
}

using Digits50 = boost::multiprecision::cpp_bin_float_50;

/// q+ = A q - e q_before, from the definitions of A and e. Slow modes cancel in it: they need the 50 digits.
template <class Number>
struct FreeMotion {
    Number A, e, h;
    Number q, v;

    FreeMotion(const StringModel& model, double q0, double v0) : h(model.shape->step_s), q(q0), v(v0) {
        using std::cos, std::exp, std::sqrt;  // of long double; those of Digits50 are found by their argument
        const Number omega = model.tuning.omega[0], sigma = model.shape->sigma[0];
        e = exp(Number(-2 * sigma * h));
        if (sigma <= omega) {
            A = 2 * exp(Number(-sigma * h)) *
                cos(Number(sqrt(Number((omega - sigma) * (omega + sigma))) * h));
        } else {
            const Number r = sqrt(Number((sigma - omega) * (sigma + omega)));
            A = exp(Number(-(sigma - r) * h)) + exp(Number(-(sigma + r) * h));
        }
    }
    void step() {
        const Number before = q - h * v;
        const Number next = A * q - e * before;
        v = (next - q) / h;
        q = next;
    }
};

struct RandomMode {
    StringModel model;
    double q, v;
};

RandomMode random_mode(test::RandomScene& random) {
    const double rate = random.logarithmic(8e3, 64e6);
    const double f = rate * random.logarithmic(1e-5, 2.3);
    const double sigma = random.count(0, 5) == 0 ? 0 : 2 * 3.14159 * f * random.logarithmic(1e-6, 30);
    return {one_mode(f, sigma, rate, random.count(1, 60)), random.uniform(-1, 1),
            random.uniform(-1, 1) * 2 * 3.14159 * std::min(f, rate)};
}

TEST(Certificate, SpeedAndExtentBoundFreeMotion) {
    test::RandomScene random(1);
    double tightest_speed = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const RandomMode mode = random_mode(random);
        const std::size_t n = mode.model.shape->stride;
        AlignedVector<double> q(n, 0.0), v(n, 0.0), speed(n), extent(n), detour(n);
        q[0] = mode.q;
        v[0] = mode.v;
        kernels::mode_bounds(n, mode.model, q.data(), v.data(), speed.data(), extent.data(), detour.data());
        FreeMotion<long double> motion(mode.model, q[0], v[0]);
        for (int step = 0; step < 60; ++step) {
            ASSERT_LE(std::abs(motion.v), static_cast<long double>(speed[0]) * (1 + 1e-9L))
                << "trial " << trial;
            ASSERT_LE(std::abs(motion.q), static_cast<long double>(extent[0]) * (1 + 1e-9L))
                << "trial " << trial;
            tightest_speed = std::max(tightest_speed, static_cast<double>(std::abs(motion.v)) / speed[0]);
            motion.step();
        }
    }
    EXPECT_GT(tightest_speed, 0.999);  // the bound is reached, so a smaller one would fail
}

TEST(Certificate, DetourBoundsTheDistanceFromTheChord) {
    test::RandomScene random(2);
    double tightest = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const RandomMode mode = random_mode(random);
        const std::size_t n = mode.model.shape->stride;
        const std::size_t m = mode.model.shape->steps_per_frame;
        AlignedVector<double> q(n, 0.0), v(n, 0.0), speed(n), extent(n), detour(n);
        q[0] = mode.q;
        v[0] = mode.v;
        kernels::mode_bounds(n, mode.model, q.data(), v.data(), speed.data(), extent.data(), detour.data());
        FreeMotion<long double> motion(mode.model, q[0], v[0]);
        std::vector<long double> path{motion.q};
        for (std::size_t step = 0; step < m; ++step) {
            motion.step();
            path.push_back(motion.q);
        }
        for (std::size_t i = 0; i <= m; ++i) {
            const long double lowest_end = std::min(path.front(), path.back());
            ASSERT_GE(path[i], lowest_end - static_cast<long double>(detour[0]) * (1 + 1e-9L))
                << "trial " << trial;
            if (detour[0] > 0) {
                tightest = std::max(tightest, static_cast<double>((lowest_end - path[i]) / detour[0]));
            }
        }
    }
    EXPECT_GT(tightest, 0.9);
}

TEST(Certificate, AKickRaisesTheSpeedBoundByItsShare) {
    test::RandomScene random(3);
    for (int trial = 0; trial < 5000; ++trial) {
        const RandomMode mode = random_mode(random);
        const StringModel& model = mode.model;
        const std::size_t n = model.shape->stride;
        AlignedVector<double> q(n, 0.0), v(n, 0.0), before(n), after(n), extent(n), detour(n);
        q[0] = mode.q;
        v[0] = mode.v;
        kernels::mode_bounds(n, model, q.data(), v.data(), before.data(), extent.data(), detour.data());
        const double impulse = random.uniform(-1, 1) * std::abs(mode.v);
        v[0] += model.shape->mobility[0] * impulse;
        q[0] += model.shape->step_s * model.shape->mobility[0] * impulse;
        kernels::mode_bounds(n, model, q.data(), v.data(), after.data(), extent.data(), detour.data());
        ASSERT_LE(after[0], (before[0] + model.tuning.certificate.kick[0] * std::abs(impulse)) * (1 + 1e-9))
            << "trial " << trial;
    }
}

TEST(Certificate, FlightIsTheStepsTaken) {
    test::RandomScene random(4);
    for (int trial = 0; trial < 1000; ++trial) {
        const RandomMode mode = random_mode(random);
        const StringModel& model = mode.model;
        const std::size_t n = model.shape->stride;
        AlignedVector<double> q(n, 0.0), v(n, 0.0), q_end(n), v_end(n), speed(n), extent(n), detour(n);
        q[0] = mode.q;
        v[0] = mode.v;
        kernels::mode_bounds(n, model, q.data(), v.data(), speed.data(), extent.data(), detour.data());
        ASSERT_TRUE(kernels::fly(n, model.tuning.flight, q.data(), v.data(), q_end.data(), v_end.data()));
        FreeMotion<Digits50> motion(model, q[0], v[0]);
        for (std::size_t step = 0; step < model.shape->steps_per_frame; ++step) motion.step();
        // The phase is right to rounding of omega times the frame's length.
        const double phase =
            model.tuning.omega[0] * model.shape->step_s * static_cast<double>(model.shape->steps_per_frame);
        const double tolerance = 1e-15 * (10 + 10 * phase);
        EXPECT_NEAR(q_end[0], static_cast<double>(motion.q), tolerance * (extent[0] + std::abs(q[0])))
            << "trial " << trial;
        EXPECT_NEAR(v_end[0], static_cast<double>(motion.v), tolerance * (speed[0] + std::abs(v[0])))
            << "trial " << trial;
    }
}

/// What the odometers and clearances claim of every gap, against the gaps themselves, computed from the rows
/// at every frame.
void expect_true_claims(const StringModel& model, std::size_t frames, const std::string& what) {
    StringState state = make_string_state(model);
    const GapBounds& bounds = state.certificate.bounds;
    const std::vector<std::size_t>& begin = model.shape->certificate.group_begin;
    for (std::size_t n = 0; n < frames; ++n) {
        advance_frame(model, state);
        for (std::size_t g = 0; g + 1 < begin.size(); ++g) {
            for (std::size_t c = begin[g]; c < begin[g + 1]; ++c) {
                long double gap = -state.contact.height[c];
                for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
                    gap += static_cast<long double>(model.shape->contact_rows[c * model.shape->stride + k]) *
                           state.displacement[k];
                }
                const double claim = bounds.open_until[c] - bounds.group_odometer[g];
                if (planned_frames(state) > 0) continue;  // readings hold at the end of what is planned
                ASSERT_LE(claim, static_cast<double>(gap) + 1e-13)
                    << what << ", frame " << n << ", contact " << c;
                if (state.certificate.validity.outdated)
                    continue;  // impulses may have taken the string out of the clearance
                ASSERT_LE(bounds.group_clearance[g], static_cast<double>(gap) + 1e-13)
                    << what << ", frame " << n;
            }
        }
    }
}

TEST(Certificate, OdometersNeverClaimMoreThanTheGap) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        for (const ImpactLaw law : {ImpactLaw::Newton, ImpactLaw::Signorini}) {
            test::RandomScene random(seed);
            SceneDescription scene = random.scene(law, 48000, 2e6);
            const StringModel model = test::compiled_string(scene);
            expect_true_claims(model, 300, "seed " + std::to_string(seed));
        }
    }
}

TEST(Certificate, OdometersOfSharedGroupsNeverClaimMoreThanTheGap) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        test::RandomScene random(seed);
        SceneDescription scene = random.scene(ImpactLaw::Signorini, 48000, 1e6);
        StringDescription& string = scene.strings[0];
        const double height = std::get<Pluck>(string.initial.shape).height_m;
        const std::vector<ProfilePoint> profile{{0, -0.05 * height}, {0.7 * string.length_m, -0.8 * height}};
        string.contacts = sampled_neck(string.length_m, 150, profile, 0);
        expect_true_claims(test::compiled_string(scene), 150, "seed " + std::to_string(seed));
    }
}

/// Gaps fall below rest by no more than reach sqrt(H), whatever the modes share of the energy, and some state
/// comes near it.
TEST(Certificate, EnergyBoundsEveryGap) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        test::RandomScene random(seed);
        SceneDescription scene = random.scene(ImpactLaw::Signorini, 48000, 1e6);
        for (ContactDescription& contact : scene.strings[0].contacts) contact.height_m = -1;  // out of reach
        const StringModel model = test::compiled_string(scene);
        for (std::size_t c = 0; c < std::min<std::size_t>(model.shape->contact_count, 3); ++c) {
            const double* row = model.shape->contact_rows.data() + c * model.shape->stride;
            const bool worst = seed % 2 == 0;
            StringState state = make_string_state(model, Metering::Off, skip_nothing);
            for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
                state.velocity[k] = worst ? 0 : random.uniform(-1, 1);
                state.displacement[k] = worst ? -row[k] / model.tuning.potential[k]
                                              : random.uniform(-1, 1) / model.tuning.omega[k];
            }
            notice_change(model, state);
            const double bound = model.shape->certificate.reach[c] * std::sqrt(energy(model, state));
            double lowest = 0;
            for (int n = 0; n < 20; ++n) {
                for (state.steps_left = model.shape->steps_per_frame; state.steps_left > 0;) {
                    double sum = 0;
                    for (std::size_t k = 0; k < model.shape->mode_count; ++k)
                        sum += row[k] * state.displacement[k];
                    lowest = std::min(lowest, sum);
                    step(model, state);
                }
            }
            EXPECT_GE(lowest, -bound) << "seed " << seed << " contact " << c;
            if (worst) {
                EXPECT_LE(lowest, -0.3 * bound) << "seed " << seed << " contact " << c;
            }
        }
    }
}

/// A force held over a frame bends the path between the frame's ends by no more than force_reach a newton.
TEST(Certificate, ForcesBendAFrameByNoMoreThanTheirReach) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        test::RandomScene random(seed);
        SceneDescription scene = random.scene(ImpactLaw::Signorini, 48000, 1e6);
        for (ContactDescription& contact : scene.strings[0].contacts) contact.height_m = -1;
        scene.strings[0].initial.shape = AtRest{};
        const StringModel model = test::compiled_string(scene);
        StringState state = make_string_state(model, Metering::Off, skip_nothing);
        test::press(model, state, random.uniform(0.1, 0.9) * model.shape->length_m, 1);
        for (std::size_t c = 0; c < std::min<std::size_t>(model.shape->contact_count, 3); ++c) {
            const double* row = model.shape->contact_rows.data() + c * model.shape->stride;
            const auto place = [&] {
                double sum = 0;
                for (std::size_t k = 0; k < model.shape->mode_count; ++k)
                    sum += row[k] * state.displacement[k];
                return sum;
            };
            StringState rest = state;
            std::vector<double> path{0};
            for (state.steps_left = model.shape->steps_per_frame; state.steps_left > 0;) {
                step(model, state);
                path.push_back(place());
            }
            const double ends = std::min(path.front(), path.back());
            EXPECT_GE(*std::min_element(path.begin(), path.end()),
                      ends - model.tuning.certificate.force_reach);
            state = rest;
        }
    }
}

/// What the strength of hands tells of the bounds is no less than what their forces on every mode do, and not
/// far from it where one hand pulls at a point.
TEST(Certificate, StrengthBoundsWhatForcesDoToEachMode) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        test::RandomScene random(seed);
        const StringModel model = test::compiled_string(random.scene(ImpactLaw::Signorini, 48000, 1e6));
        std::vector<AlignedVector<double>> rows(1 + seed % 3, AlignedVector<double>(model.shape->stride));
        std::vector<const double*> row_of;
        std::vector<double> force_N;
        for (AlignedVector<double>& row : rows) {
            const double x = random.uniform(0.05, 0.95) * model.shape->length_m;
            write_point_row(model, model.shape->stride, x, random.uniform(0, 0.02) * model.shape->length_m,
                            row.data());
            row_of.push_back(row.data());
            force_N.push_back(random.uniform(-2, 2));
        }
        const auto kicks_of = [&](bool passive) {
            StringState state = make_string_state(model);
            hold_forces(state, {rows.size(), force_N.data(), row_of.data()}, model.shape->stride,
                        model.shape->stride, passive);
            add_kicks(model, state);
            return state.certificate.bounds.kicks;
        };
        const KickState by_mode = kicks_of(false), by_strength = kicks_of(true);
        const auto bounds = [](double least, double bound) { return least <= bound * (1 + 1e-12); };
        EXPECT_TRUE(bounds(by_mode.speed, by_strength.speed)) << seed;
        EXPECT_TRUE(bounds(by_mode.overtones, by_strength.overtones)) << seed;
        EXPECT_TRUE(bounds(by_mode.detour, by_strength.detour)) << seed;
        EXPECT_TRUE(bounds(by_mode.low_detour, by_strength.low_detour)) << seed;
        EXPECT_TRUE(bounds(by_mode.frame_detour, by_strength.frame_detour)) << seed;
        EXPECT_TRUE(bounds(by_mode.frame_low_detour, by_strength.frame_low_detour)) << seed;
        if (rows.size() == 1) {
            EXPECT_LT(by_strength.speed, 10 * by_mode.speed) << seed;
        }
    }
}

}  // namespace
}  // namespace jawari
