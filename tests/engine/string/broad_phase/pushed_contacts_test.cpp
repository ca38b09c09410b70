#include "string/broad_phase/pushed_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "string/broad_phase/gap_certificate.h"
#include "string/frame/frame.h"
#include "support/scenes.h"

namespace jawari {
namespace {

/// Two contacts of a string, the first of them near and struck in a step that leaves `steps_left`.
struct Struck {
    StringModel model;
    StringState state;
    double pushed_m =
        0;  ///< what the impulse may move the other gap by until the frame's end, from the definition
};

Struck struck_string(double growth) {
    test::RandomScene random(5);
    SceneDescription scene = random.scene(ImpactLaw::Signorini, 48000, 1e6);
    StringDescription& string = scene.strings[0];
    string.contacts.resize(2);
    for (std::size_t c = 0; c < 2; ++c) {
        string.contacts[c].position_m = (0.3 + 0.1 * static_cast<double>(c)) * string.length_m;
        string.contacts[c].height_m = -0.01;
        string.contacts[c].side = Side::Below;
    }
    Struck struck{test::compiled_string(scene), {}, 0};
    StringModel& model = struck.model;
    model.tuning.certificate.push_growth = growth;
    struck.state = make_string_state(model);
    StringState& state = struck.state;
    state.contact.near.fill_to(1);
    state.contact.is_near = {1, 0};
    state.contact.candidates.fill_to(1);
    state.contact.impulse[0] = 0.003;
    state.steps_left = 7;
    double speed = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k)
        speed += std::abs(model.shape->contact_rows[k] * model.tuning.certificate.kick[k] *
                          model.shape->contact_rows[model.shape->stride + k]);
    struck.pushed_m = growth * speed * 0.003 * 7 * model.shape->step_s;
    return struck;
}

void set_margin(Struck& struck, double margin_m) {
    struck.state.certificate.bounds.margin[1] = margin_m;
    struck.state.certificate.bounds.group_margin[1] = margin_m;
}

TEST(Push, AContactThatTheImpulseMayReachJoinsTheStep) {
    for (const double growth : {1.0, 1.7}) {
        Struck out_of_reach = struck_string(growth);
        set_margin(out_of_reach, 1.001 * out_of_reach.pushed_m);
        EXPECT_FALSE(admit_pushed_in_step(out_of_reach.model, out_of_reach.state));
        EXPECT_EQ(out_of_reach.state.contact.near.size(), 1U);

        Struck in_reach = struck_string(growth);
        set_margin(in_reach, 0.999 * in_reach.pushed_m);
        EXPECT_TRUE(admit_pushed_in_step(in_reach.model, in_reach.state));
        ASSERT_EQ(in_reach.state.contact.near.size(), 2U);
        EXPECT_EQ(in_reach.state.contact.near[1], 1U);
        EXPECT_FALSE(admit_pushed_in_step(in_reach.model, in_reach.state));  // nobody is left
    }
}

TEST(Push, ImpulsesOfAFrameAddUp) {
    Struck struck = struck_string(1);
    set_margin(struck, 1.5 * struck.pushed_m);
    EXPECT_FALSE(admit_pushed_in_step(struck.model, struck.state));
    charge_impulses(struck.model, struck.state);
    EXPECT_NEAR(struck.state.certificate.bounds.group_push[1], struck.pushed_m, 1e-8 * struck.pushed_m);
    EXPECT_TRUE(admit_pushed_in_step(struck.model, struck.state));
}

/// Sums of bounds are rounded; what they bound is taken for 1e-9 more. A margin between the two is none.
TEST(Push, TheBoundIsWidenedInStepsAndInFrames) {
    constexpr double between = 1 + 0.5e-9;
    Struck step = struck_string(1);
    set_margin(step, between * step.pushed_m);
    EXPECT_TRUE(admit_pushed_in_step(step.model, step.state));

    Struck frame = struck_string(1);
    ASSERT_FALSE(frame.model.tuning.response.empty());
    frame.state.near_frame.struck.push(0);
    frame.state.contact.frame_impulse[0] = 0.003;
    const double path_m = 0.003 * frame.model.tuning.certificate.push_path[2];  // of contact 0 on group 1
    ASSERT_GT(path_m, 0);
    set_margin(frame, (1 + 2e-9) * path_m);
    EXPECT_FALSE(admit_pushed_in_frame(frame.model, frame.state));
    set_margin(frame, between * path_m);
    EXPECT_TRUE(admit_pushed_in_frame(frame.model, frame.state));
    EXPECT_EQ(frame.state.contact.near.size(), 2U);
    EXPECT_GE(frame.state.certificate.bounds.group_push[1], between * path_m);
}

/// How far 1 N s at a contact lowers the gaps of a group within the frame, step by step; Newton's law acts on
/// what the gap would be half a step later.
double stepped_push(const StringModel& model, std::size_t struck, std::size_t first, std::size_t last) {
    const std::size_t n = model.shape->stride;
    StringState state = make_string_state(model, Metering::Off, skip_nothing);
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        state.velocity[k] = model.shape->mobility[k] * model.shape->contact_rows[struck * n + k];
        state.displacement[k] = model.shape->step_s * state.velocity[k];
    }
    notice_change(model, state);
    const double ahead_s = model.shape->law == ImpactLaw::Newton ? model.shape->step_s / 2 : 0;
    double lowest = 0;
    for (std::size_t step_count = 0; step_count < model.shape->steps_per_frame; ++step_count) {
        if (step_count > 0) step(model, state);
        for (std::size_t c = first; c < last; ++c) {
            const double* row = model.shape->contact_rows.data() + c * n;
            const double gap =
                std::inner_product(row, row + model.shape->mode_count, state.displacement.begin(), 0.0);
            const double rate =
                std::inner_product(row, row + model.shape->mode_count, state.velocity.begin(), 0.0);
            lowest = std::min({lowest, gap, gap + ahead_s * rate});
        }
    }
    return -lowest;
}

TEST(Push, TabulatedOnesAreWhatSteppingShows) {
    for (const ImpactLaw law : {ImpactLaw::Newton, ImpactLaw::Signorini}) {
        for (const std::size_t contacts : {5U, 100U}) {  // own responses, and those of a uniform neck
            test::RandomScene random(11);
            SceneDescription scene = random.scene(law, 48000, 1e6);
            StringDescription& string = scene.strings[0];
            const std::vector<ProfilePoint> far{{0, -1}, {0.7 * string.length_m, -1}};
            string.contacts = sampled_neck(string.length_m, contacts, far, 0);
            const StringModel model = test::compiled_string(scene);
            ASSERT_EQ(model.shape->contact_count, contacts);
            const std::vector<std::size_t>& begin = model.shape->certificate.group_begin;
            const std::size_t groups = begin.size() - 1;
            double largest = 0;
            for (const double push : model.tuning.certificate.push_path) largest = std::max(largest, push);
            for (std::size_t g = 0; g < groups; g += 1 + groups / 7) {
                for (std::size_t struck = 0; struck < contacts; struck += 1 + contacts / 5) {
                    EXPECT_NEAR(model.tuning.certificate.push_path[g * contacts + struck],
                                stepped_push(model, struck, begin[g], begin[g + 1]), 1e-9 * largest)
                        << "group " << g << ", contact " << struck;
                }
            }
        }
    }
}

}  // namespace
}  // namespace jawari
