// Each law at moments worked out by hand.
#include "string/contact/impact_law.h"

#include <gtest/gtest.h>

namespace jawari {
namespace {

ContactMoment moment(double gap, double gap_before, double restitution) {
    ContactMoment c;
    c.gap = gap;
    c.gap_before = gap_before;
    c.restitution = restitution;
    return c;
}

TEST(ImpactLaw, NewtonActsOnGapsThatHalfAStepWouldClose) {
    // Falling by 2 a step: from 1.5 half a step leaves 0.5; from 1 it just closes; from 0.5 it is past.
    for (const ImpactLaw law : {ImpactLaw::Newton, ImpactLaw::Passive}) {
        EXPECT_FALSE(is_candidate(law, moment(1.5, 3.5, 0)));
        EXPECT_TRUE(is_candidate(law, moment(1.0, 3.0, 0)));
        EXPECT_TRUE(is_candidate(law, moment(0.5, 2.5, 0)));
        // Inside and leaving: at -1 rising by 4 a step half a step opens it, rising by 1 does not.
        EXPECT_FALSE(is_candidate(law, moment(-1, -5, 0)));
        EXPECT_TRUE(is_candidate(law, moment(-1, -2, 0)));
    }
}

TEST(ImpactLaw, SignoriniAndPaoliSchatzmanLookAtEveryContact) {
    for (const ImpactLaw law : {ImpactLaw::Signorini, ImpactLaw::PaoliSchatzman}) {
        EXPECT_TRUE(is_candidate(law, moment(100, 99, 0.5)));
        EXPECT_TRUE(is_candidate(law, moment(-1, -5, 0.5)));
    }
}

TEST(ImpactLaw, NewtonReversesTheGapsChange) {
    // Fell from 3 to 1: e = 0 stays at 1, e = 1/2 returns half of the fall, e = 1 all of it.
    EXPECT_EQ(target_gap(ImpactLaw::Newton, moment(1, 3, 0)), 1);
    EXPECT_EQ(target_gap(ImpactLaw::Newton, moment(1, 3, 0.5)), 2);
    EXPECT_EQ(target_gap(ImpactLaw::Newton, moment(1, 3, 1)), 3);
    // Rose from -4 to -2, still a candidate after a fall of its neighbours: the law pulls its target down.
    EXPECT_EQ(target_gap(ImpactLaw::Newton, moment(-2, -4, 0.5)), -3);
}

TEST(ImpactLaw, PassiveIsNewtonOnApproachAndNeverAboveTheGapBefore) {
    EXPECT_EQ(target_gap(ImpactLaw::Passive, moment(1, 3, 0)), 1);
    EXPECT_EQ(target_gap(ImpactLaw::Passive, moment(1, 3, 0.5)), 2);
    EXPECT_EQ(target_gap(ImpactLaw::Passive, moment(1, 3, 1)), 3);
    EXPECT_EQ(target_gap(ImpactLaw::Passive, moment(-2, -2, 0.7)), -2);
    EXPECT_EQ(target_gap(ImpactLaw::Passive, moment(-2, -4, 0.5)), -4);
    EXPECT_EQ(target_gap(ImpactLaw::Passive, moment(-2, -4, 0)), -4);
}

TEST(ImpactLaw, SignoriniKeepsTheGapNotNegativeWhateverTheRestitution) {
    EXPECT_EQ(target_gap(ImpactLaw::Signorini, moment(1, 3, 0)), 0);
    EXPECT_EQ(target_gap(ImpactLaw::Signorini, moment(-1, 2, 1)), 0);
    // Left inside by a truncated solve: no further in than it was, never shot out.
    EXPECT_EQ(target_gap(ImpactLaw::Signorini, moment(-1, -3, 1)), -3);
}

TEST(ImpactLaw, PaoliSchatzmanReflectsThePositionOneStepEarlier) {
    EXPECT_EQ(target_gap(ImpactLaw::PaoliSchatzman, moment(-1, 3, 0)), 0);
    EXPECT_EQ(target_gap(ImpactLaw::PaoliSchatzman, moment(-1, 3, 0.5)), -1.5);
    EXPECT_EQ(target_gap(ImpactLaw::PaoliSchatzman, moment(-1, 3, 1)), -3);
    // Inside one step earlier: reflected as well, though the gap is open now.
    EXPECT_EQ(target_gap(ImpactLaw::PaoliSchatzman, moment(1, -2, 0.5)), 1);
    EXPECT_EQ(target_gap(ImpactLaw::PaoliSchatzman, moment(1, -2, 1)), 2);
}

TEST(ImpactLaw, DepthThatIsTheNumbersDoingIsNotKept) {
    ContactMoment c = moment(-0.1, -0.25, 0);
    c.excused = 0.5;
    EXPECT_EQ(target_gap(ImpactLaw::Signorini, c), 0);
    // What is deeper comes out step by step, so that the work of each is below rounding.
    c.gap_before = -3;
    EXPECT_EQ(target_gap(ImpactLaw::Signorini, c), -2.5);
    // A gap that was open has the same target as without.
    c.gap_before = 2;
    EXPECT_EQ(target_gap(ImpactLaw::Signorini, c), 0);
}

TEST(ImpactLaw, EveryPassiveLawsTargetIsAtMostTheGapBefore) {
    for (const double gap : {-3.0, -1.0, 0.0, 0.5, 2.0}) {
        for (const double before : {-4.0, -1.0, -0.5, 0.0, 1.0, 5.0}) {
            for (const double e : {0.0, 0.3, 1.0}) {
                EXPECT_LE(target_gap(ImpactLaw::Passive, moment(gap, before, e)), before);
                EXPECT_LE(target_gap(ImpactLaw::Signorini, moment(gap, before, e)), before);
            }
        }
    }
    // The known offenders: a candidate that already separates, and a gap that was closed.
    EXPECT_GT(target_gap(ImpactLaw::Newton, moment(-2, -4, 0.5)), -4);
    EXPECT_GT(target_gap(ImpactLaw::PaoliSchatzman, moment(-2, -4, 0.5)), -4);
    EXPECT_TRUE(is_passive(ImpactLaw::Passive) && is_passive(ImpactLaw::Signorini));
    EXPECT_FALSE(is_passive(ImpactLaw::Newton) || is_passive(ImpactLaw::PaoliSchatzman));
}

TEST(ImpactLaw, ThetaSchemeWorksOnVelocities) {
    ContactMoment c = moment(1, 1e300, 0.5);  // the gap before does not matter
    c.scheme = Scheme::Theta;
    c.approach = -2;
    EXPECT_TRUE(is_candidate(ImpactLaw::Newton, c));
    c.gap = 1.5;
    EXPECT_FALSE(is_candidate(ImpactLaw::Newton, c));
    // S v+ = -e S v = 0.5 * 2 / h per h, so y+ = y + theta * 1 + (1 - theta) * (-2).
    c.theta = 1;
    EXPECT_EQ(target_gap(ImpactLaw::Newton, c), 1.5 + 1);
    c.theta = 0.5;
    EXPECT_EQ(target_gap(ImpactLaw::Newton, c), 1.5 + 0.5 - 1);
    c.theta = 0.75;
    EXPECT_EQ(target_gap(ImpactLaw::Newton, c), 1.5 + 0.75 - 0.5);
}

}  // namespace
}  // namespace jawari
