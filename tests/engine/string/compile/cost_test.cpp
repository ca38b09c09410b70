// The known cost of a frame: counted by hand for a small string, and in order.
#include "jawari/scene/cost.h"

#include <gtest/gtest.h>

#include "support/scenes.h"

namespace jawari {
namespace {

StringModel string_with(std::size_t modes, std::size_t contacts, double contact_rate_hz,
                        ImpactLaw law = ImpactLaw::Signorini) {
    SceneDescription scene;
    scene.law = law;
    scene.contact_rate_hz = contact_rate_hz;
    scene.strings.push_back(test::bass_string(modes));
    scene.strings[0].contacts.resize(contacts);
    return test::compiled_string(scene);
}

TEST(FrameCost, AFreeStringCostsItsFlight) {
    const FrameCost cost = frame_cost(string_with(16, 0, 48000 * 5));
    EXPECT_EQ(cost.flight, 4 * 16);
    EXPECT_EQ(cost.permanent_contact, cost.flight);
}

TEST(FrameCost, OneContactOfAShortFrameCountedByHand) {
    // 16 modes, one contact padded to eight, five steps: three for the motion and eight for the rates; three
    // and one for the impulse, two to add it up. Then ten later rates and five gaps, twice where corrected,
    // and five solves of eight products, twice, and eight offsets.
    const double modes = 16 * (5 * (3 + 8) + 5 * (3 + 1) + 2);
    const double contact = 8 * (10 + 2 * 5) + 5 * 8 * (2 + 1);
    EXPECT_EQ(frame_cost(string_with(16, 1, 48000 * 5)).permanent_contact, modes + contact);
}

TEST(FrameCost, OneContactCountedByHand) {
    // The law keeps frames from being short. 16 modes, one contact, five steps: bounds 17, three sums over
    // them for the one group, gaps at both ends, flight 4; gap and rate at the start; five steps of three for
    // the motion and one for the rate; five of three and one for the impulse, four to add it up. Then 15
    // responses and five gaps, and five solves of two products and one residual.
    const double looking = 16 * (17 + 3 + 2 + 4);
    const double rates = 16 * (2 + 5 * 4);
    const double impulses = 16 * (5 * 4 + 4);
    const double contact = 15 + 5 + 5 * (2 + 1);
    EXPECT_EQ(frame_cost(string_with(16, 1, 48000 * 5, ImpactLaw::PaoliSchatzman)).permanent_contact,
              looking + rates + impulses + contact);
}

TEST(FrameCost, TheBoundOfOneContactOfAShortFrameCountedByHand) {
    // What is counted above for a frame that is not short, to look, gap and rate at the start, and all of a
    // short frame but its five solves. Each of those makes the table of eight anew and fails after two pivots
    // of 16; the general one then begins with two products and goes to its end, 4 + 16 pivots with two
    // factors of a third, four products and a residual each.
    const double looking = 16 * (17 + 3 + 2 + 4);
    const double start = 16 * 2;
    const double modes = 16 * (5 * (3 + 8) + 5 * (3 + 1) + 2);
    const double spread = 8 * (10 + 2 * 5);
    const double solve = 8 + 2 * (8 + 8) + 2 + 20 * (2.0 / 3 + 4 + 1);
    EXPECT_DOUBLE_EQ(frame_cost(string_with(16, 1, 48000 * 5)).bound,
                     looking + start + modes + spread + 5 * solve);
}

TEST(FrameCost, ABoundIsNoLessThanPermanentContactAndThatNoLessThanFlight) {
    for (const std::size_t contacts : {1U, 5U, 20U}) {
        for (const double rate_hz : {48e3, 192e3, 2016e3}) {
            const FrameCost cost = frame_cost(string_with(100, contacts, rate_hz));
            EXPECT_GT(cost.permanent_contact, cost.flight);
            EXPECT_GE(cost.bound, cost.permanent_contact);
        }
    }
}

TEST(FrameCost, OfASceneIsTheSumOverItsStrings) {
    SceneDescription scene;
    scene.strings = {test::bass_string(50), test::bass_string(80)};
    const SceneModel model = compile(scene).value();
    EXPECT_EQ(worst_frame_cost(model), frame_cost(model.strings[0]).permanent_contact +
                                           frame_cost(model.strings[1]).permanent_contact);
}

}  // namespace
}  // namespace jawari
