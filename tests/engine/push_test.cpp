#include "push.h"

#include <gtest/gtest.h>

#include <cmath>

#include "certificate.h"
#include "scenes.h"

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
    model.certificate.push = model.certificate.push_speed;  // as a retuned string's
    model.certificate.push_growth = growth;
    struck.state = make_string_state(model);
    StringState& state = struck.state;
    choose_all_contacts(model, state);
    state.contact.near_count = 1;
    state.contact.is_near[1] = 0;
    state.contact.candidates[0] = 0;
    state.contact.candidate_count = 1;
    state.contact.impulse[0] = 0.003;
    state.steps_left = 7;
    double speed = 0;
    for (std::size_t k = 0; k < model.mode_count; ++k)
        speed += std::abs(model.contact_rows[k] * model.certificate.kick[k] *
                          model.contact_rows[model.stride + k]);
    struck.pushed_m = growth * speed * 0.003 * 7 * model.step_s;
    return struck;
}

void set_margin(Struck& struck, double margin_m) {
    struck.state.certificate.margin[1] = margin_m;
    struck.state.certificate.group_margin[1] = margin_m;
}

TEST(Push, AContactThatTheImpulseMayReachJoinsTheStep) {
    for (const double growth : {1.0, 1.7}) {
        Struck out_of_reach = struck_string(growth);
        set_margin(out_of_reach, 1.001 * out_of_reach.pushed_m);
        EXPECT_FALSE(admit_pushed_contacts(out_of_reach.model, out_of_reach.state));
        EXPECT_EQ(out_of_reach.state.contact.near_count, 1U);

        Struck in_reach = struck_string(growth);
        set_margin(in_reach, 0.999 * in_reach.pushed_m);
        EXPECT_TRUE(admit_pushed_contacts(in_reach.model, in_reach.state));
        ASSERT_EQ(in_reach.state.contact.near_count, 2U);
        EXPECT_EQ(in_reach.state.contact.near[1], 1U);
        EXPECT_FALSE(admit_pushed_contacts(in_reach.model, in_reach.state));  // nobody is left
    }
}

TEST(Push, ImpulsesOfAFrameAddUp) {
    Struck struck = struck_string(1);
    set_margin(struck, 1.5 * struck.pushed_m);
    EXPECT_FALSE(admit_pushed_contacts(struck.model, struck.state));
    charge_impulses(struck.model, struck.state);
    EXPECT_NEAR(struck.state.certificate.group_push[1], struck.pushed_m, 1e-8 * struck.pushed_m);
    EXPECT_TRUE(admit_pushed_contacts(struck.model, struck.state));
}

}  // namespace
}  // namespace jawari
