// The steps of a short frame in contact space against the conditions that define their impulses, in long
// double: 0 <= y+ perp lambda >= 0, which have one solution.
#include "string/frame/short_frame_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "string/frame/short_frame.h"
#include "support/scenes.h"

namespace jawari {
namespace {

/// Contacts of a string whose frames are `steps` long.
StringModel short_string(std::uint64_t seed, std::size_t contacts, double steps) {
    test::RandomScene random(seed);
    SceneDescription scene;
    scene.contact_rate_hz = 48000 * steps;
    scene.strings.push_back(test::bass_string(160));
    scene.strings[0].contacts.clear();
    for (std::size_t c = 0; c < contacts; ++c)
        scene.strings[0].contacts.push_back({0.863 * random.uniform(0.02, 0.98), -1e-3, 0, Side::Below});
    StringModel model = test::compiled_string(scene);
    EXPECT_TRUE(has_short_frames(model));
    return model;
}

/// All gaps within 1 um, half of them closed.
void set_gaps(const StringModel& model, StringState& state, test::RandomScene& random) {
    for (std::size_t c = 0; c < model.shape->contact_stride; ++c) {
        const bool real = c < model.shape->contact_count;
        state.contact.gap[c] = real ? std::max(0.0, random.uniform(-1e-6, 1e-6)) : 1.0;
        state.contact.gap_before[c] = real ? std::max(0.0, random.uniform(-1e-6, 1e-6)) : 1.0;
    }
}

/// Rates that close some gaps: the contacts move together, each a little by itself.
void set_rates(const StringModel& model, StringState& state, test::RandomScene& random) {
    const double together = random.uniform(-1, 1);
    for (std::size_t n = 0; n < model.shape->steps_per_frame; ++n) {
        for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
            state.short_frame.rates[n * model.shape->contact_stride + c] =
                together + random.uniform(-0.3, 0.3);
        }
    }
}

/// What impulses of step n do to the gap of contact c at the end of step `at`, by the modes themselves.
class ModalResponses {
  public:
    explicit ModalResponses(const StringModel& model) : model_(model) {
        const std::size_t m = model.shape->steps_per_frame;
        table_.assign(m * model.shape->contact_count * model.shape->contact_count, 0);
        for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
            const long double h = model.shape->step_s;
            const long double e = static_cast<long double>(model.shape->carry[k]) + model.shape->change[k];
            long double v = model.shape->mobility[k];
            long double q = h * v;
            for (std::size_t n = 0; n < m; ++n) {
                add_mode(k, n, q);
                v = e * v + model.tuning.restoring[k] * q;
                q += h * v;
            }
        }
    }

    /// `later` steps after 1 N s at `struck`.
    [[nodiscard]] long double gap(std::size_t later, std::size_t struck, std::size_t c) const {
        return table_[(later * model_.shape->contact_count + struck) * model_.shape->contact_count + c];
    }

  private:
    void add_mode(std::size_t k, std::size_t n, long double q) {
        const std::size_t count = model_.shape->contact_count;
        for (std::size_t a = 0; a < count; ++a) {
            for (std::size_t b = 0; b < count; ++b) {
                table_[(n * count + a) * count + b] +=
                    q * model_.shape->contact_rows[a * model_.shape->stride + k] *
                    model_.shape->contact_rows[b * model_.shape->stride + k];
            }
        }
    }

    const StringModel& model_;
    std::vector<long double> table_;
};

struct Gaps {
    AlignedVector<double> start;
    AlignedVector<double> rates;
};

/// Checks the steps just solved. Returns the number of impulses.
std::size_t expect_solved(const StringModel& model, const StringState& state, const Gaps& given,
                          const ModalResponses& responses) {
    const std::size_t stride = model.shape->contact_stride;
    const AlignedVector<double>& impulses = state.short_frame.impulses;
    std::size_t count = 0;
    for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
        long double free = given.start[c];
        long double sum = 0;
        for (std::size_t n = 0; n < model.shape->steps_per_frame; ++n) {
            free += static_cast<long double>(model.shape->step_s) * given.rates[n * stride + c];
            long double gap = free;
            for (std::size_t before = 0; before <= n; ++before) {
                for (std::size_t other = 0; other < model.shape->contact_count; ++other)
                    gap += responses.gap(n - before, other, c) * impulses[before * stride + other];
            }
            const double impulse = impulses[n * stride + c];
            EXPECT_GE(impulse, 0);
            EXPECT_GE(gap, -1e-17L);
            if (impulse > 0) {
                EXPECT_LE(std::abs(gap), 1e-17L);
            }
            if (n + 1 == model.shape->steps_per_frame) {
                EXPECT_NEAR(state.contact.gap[c], static_cast<double>(gap), 1e-17);
            }
            sum += impulse;
            count += impulse > 0 ? 1 : 0;
        }
        EXPECT_NEAR(state.contact.frame_impulse[c], static_cast<double>(sum),
                    1e-15 * static_cast<double>(sum));
    }
    return count;
}

/// Many frames in a row, so that active sets come and go and the table is made anew.
void expect_all_solved(const StringModel& model, std::uint64_t seed, int frames) {
    test::RandomScene random(seed);
    StringState state = make_string_state(model);
    const ModalResponses responses(model);
    std::size_t impulses = 0;
    for (int frame = 0; frame < frames; ++frame) {
        set_gaps(model, state, random);
        set_rates(model, state, random);
        const Gaps given{state.contact.gap, state.short_frame.rates};
        std::fill(state.contact.frame_impulse.begin(), state.contact.frame_impulse.end(), 0.0);
        const std::uint64_t before = state.counters.impulses;
        ASSERT_TRUE(kernels::solve_steps(model, state));
        const std::size_t found = expect_solved(model, state, given, responses);
        EXPECT_EQ(state.counters.impulses - before, found);
        impulses += found;
        ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << " frame " << frame;
    }
    EXPECT_GT(impulses, static_cast<std::size_t>(frames) / 4);
}

TEST(ContactKernels, ImpulsesOfEveryStepAreTheSolution) {
    std::uint64_t seed = 0;
    for (const std::size_t contacts : {1U, 3U, 8U, 22U, 30U}) {
        for (const double steps : {1.0, 2.0, 4.0, 5.0}) {
            ++seed;
            expect_all_solved(short_string(seed, contacts, steps), seed, 60);
        }
    }
}

TEST(ContactKernels, CoincidentContactsAreLeftToTheGeneralSolver) {
    SceneDescription scene;
    scene.contact_rate_hz = 192000;
    scene.strings.push_back(test::bass_string(160));
    for (std::size_t c = 1; c < 20; c += 3)
        scene.strings[0].contacts[c].position_m = scene.strings[0].contacts[c - 1].position_m;
    expect_all_solved(test::compiled_string(scene), 5, 100);
}

TEST(ContactKernels, AGapThatIsNotFiniteIsReported) {
    const StringModel model = short_string(3, 10, 4);
    StringState state = make_string_state(model);
    test::RandomScene random(3);
    set_gaps(model, state, random);
    set_rates(model, state, random);
    state.short_frame.rates[model.shape->contact_stride + 7] = std::nan("");
    EXPECT_FALSE(kernels::solve_steps(model, state));
}

}  // namespace
}  // namespace jawari
