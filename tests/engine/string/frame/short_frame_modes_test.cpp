// The modes through a short frame against stepping in long double.
#include "string/frame/short_frame_modes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "string/frame/short_frame.h"
#include "support/scenes.h"

namespace jawari {
namespace {

StringModel short_string(std::size_t modes, std::size_t contacts, std::size_t steps) {
    SceneDescription scene;
    scene.contact_rate_hz = 48000 * static_cast<double>(steps);
    scene.strings.push_back(test::bass_string(modes));
    scene.strings[0].contacts.resize(contacts);
    StringModel model = test::compiled_string(scene);
    EXPECT_TRUE(has_short_frames(model));
    return model;
}

struct Motion {
    std::vector<long double> q, v;   ///< at the end, over modes
    std::vector<long double> rates;  ///< steps x contacts
};

/// One mode after the other, step after step, with the forces of state.excitation and the given impulses
/// (steps x contact_stride, or none).
Motion stepped(const StringModel& model, const StringState& state, const double* impulses) {
    Motion motion;
    const std::size_t count = model.shape->contact_count;
    motion.rates.assign(model.shape->steps_per_frame * count, 0);
    const ExcitationState& excitation = state.excitation;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        long double q = state.displacement[k];
        long double v = state.velocity[k];
        for (std::size_t n = 0; n < model.shape->steps_per_frame; ++n) {
            const auto elapsed = static_cast<long double>(excitation.elapsed + n);
            long double drive = model.shape->step_s * (excitation.held[k] + elapsed * excitation.ramp[k]);
            for (std::size_t c = 0; impulses != nullptr && c < count; ++c)
                drive += static_cast<long double>(impulses[n * model.shape->contact_stride + c]) *
                         model.shape->contact_rows[c * model.shape->stride + k];
            const long double e = static_cast<long double>(model.shape->carry[k]) + model.shape->change[k];
            v = e * v + model.tuning.restoring[k] * q + model.shape->mobility[k] * drive;
            q += model.shape->step_s * v;
            for (std::size_t c = 0; c < count; ++c)
                motion.rates[n * count + c] += v * model.shape->contact_rows[c * model.shape->stride + k];
        }
        motion.q.push_back(q);
        motion.v.push_back(v);
    }
    return motion;
}

void expect_end(const StringModel& model, const StringState& state, const Motion& exact) {
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        const auto q = static_cast<double>(exact.q[k]);
        const auto v = static_cast<double>(exact.v[k]);
        ASSERT_NEAR(state.displacement_flown[k], q, 1e-14 * (std::abs(q) + 1e-3)) << k;
        ASSERT_NEAR(state.velocity_flown[k], v, 1e-14 * (std::abs(v) + 100)) << k;
    }
    for (std::size_t k = model.shape->mode_count; k < model.shape->stride; ++k) {
        ASSERT_EQ(state.displacement_flown[k], 0);
        ASSERT_EQ(state.velocity_flown[k], 0);
    }
}

/// Modes, contacts and steps that fill vectors and blocks, and such that do not.
const std::array<std::array<std::size_t, 3>, 7> sizes{
    {{1, 1, 1}, {7, 3, 2}, {57, 20, 4}, {96, 9, 5}, {166, 17, 10}, {40, 20, 8}, {300, 5, 16}}};

TEST(ShortMotion, RatesAndEndAreThoseOfSteppingWithAndWithoutForces) {
    for (const auto& [modes, contacts, steps] : sizes) {
        const StringModel model = short_string(modes, contacts, steps);
        test::RandomScene random(modes);
        for (const bool forced : {false, true}) {
            StringState state = make_string_state(model);
            if (forced) test::press(model, state, 0.3 * model.shape->length_m, 5, -0.2);
            state.excitation.elapsed = forced ? 3 : 0;
            for (std::size_t k = 0; k < modes; ++k) {
                state.displacement[k] = 1e-3 * random.uniform(-1, 1);
                state.velocity[k] = random.uniform(-1, 1);
            }
            const Motion exact = stepped(model, state, nullptr);
            ASSERT_TRUE(kernels::run_freely(model, state));
            expect_end(model, state, exact);
            for (std::size_t n = 0; n < steps; ++n) {
                for (std::size_t c = 0; c < contacts; ++c) {
                    const auto rate = static_cast<double>(exact.rates[n * contacts + c]);
                    ASSERT_NEAR(state.short_frame.rates[n * model.shape->contact_stride + c], rate,
                                1e-14 * (std::abs(rate) + 300))
                        << modes << " modes, contact " << c << ", step " << n;
                }
                for (std::size_t c = contacts; c < model.shape->contact_stride; ++c)
                    ASSERT_EQ(state.short_frame.rates[n * model.shape->contact_stride + c], 0);
            }
        }
    }
}

TEST(ShortMotion, TheResponseIsThatOfSteppingUnderTheImpulses) {
    for (const auto& [modes, contacts, steps] : sizes) {
        const StringModel model = short_string(modes, contacts, steps);
        test::RandomScene random(modes);
        StringState state = make_string_state(model);
        ShortFrameState& frame = state.short_frame;
        for (std::size_t c = 0; c < contacts; c += 2) frame.struck.push(c);
        for (std::size_t n = 0; n < steps; ++n) {
            for (std::size_t c = 0; c < contacts; c += 2)
                frame.impulses[n * model.shape->contact_stride + c] = 1e-4 * random.uniform(0, 1);
        }
        const Motion exact = stepped(model, state, frame.impulses.data());
        ASSERT_TRUE(kernels::run_freely(model, state));
        ASSERT_TRUE(kernels::add_response(model, state));
        expect_end(model, state, exact);
    }
}

TEST(ShortMotion, AModeThatIsNotFiniteIsReported) {
    const StringModel model = short_string(30, 5, 4);
    StringState state = make_string_state(model);
    state.velocity[29] = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(kernels::run_freely(model, state));
}

}  // namespace
}  // namespace jawari
