// The decision table of frame_kind.h, row by row, and the kinds that real strings take.
#include "string/frame/frame_kind.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "jawari/jawari.h"
#include "string/frame/frame.h"
#include "string/frame/short_frame.h"
#include "support/scenes.h"

namespace jawari {
namespace {

using Answer = BroadPhaseAnswer;
constexpr std::optional<FrameKind> test_it;  ///< the frame must be tested first

StringModel bass(ImpactLaw law, double contact_rate_hz, Scheme scheme = Scheme::Exact) {
    SceneDescription scene;
    scene.law = law;
    scene.scheme = scheme;
    scene.contact_rate_hz = contact_rate_hz;
    scene.strings.push_back(test::bass_string(40));
    return test::compiled_string(scene);
}

const StringModel& short_model() {
    static const StringModel model = bass(ImpactLaw::Signorini, 4 * 48000);
    return model;
}

const StringModel& long_model() {
    static const StringModel model = bass(ImpactLaw::Newton, 40 * 48000);
    return model;
}

void expect_kinds(const StringModel& model, const StringState& state,
                  const std::vector<std::optional<FrameKind>>& expected, const char* what) {
    const std::vector<Answer> answers{Answer::NotAsked, Answer::Planned, Answer::PlanFailed, Answer::Open,
                                      Answer::MayClose};
    ASSERT_EQ(expected.size(), answers.size());
    for (std::size_t i = 0; i < answers.size(); ++i) {
        EXPECT_EQ(choose_frame_kind(model, state, answers[i]), expected[i]) << what << ", answer " << i;
    }
}

std::vector<std::optional<FrameKind>> always(FrameKind kind) {
    return std::vector<std::optional<FrameKind>>(5, kind);
}

TEST(FrameKind, TheTestedStringIsShortOrNot) {
    EXPECT_TRUE(solves_short_frames(short_model(), make_string_state(short_model())));
    EXPECT_FALSE(solves_short_frames(long_model(), make_string_state(long_model())));
    EXPECT_FALSE(long_model().tuning.response.empty());
}

TEST(FrameKind, ASleepingStringSleepsOnUntilItIsMoved) {
    StringState state = make_string_state(long_model());
    state.asleep = true;
    expect_kinds(long_model(), state, always(FrameKind::Asleep), "asleep");
    StringState moved = state;
    move_contact(long_model(), moved, 0, 1e-3, 10);
    expect_kinds(long_model(), moved, always(FrameKind::Uniform), "an obstacle moves");
    test::press(long_model(), state, 0.3, 1);
    EXPECT_NE(choose_frame_kind(long_model(), state, Answer::NotAsked), FrameKind::Asleep);
}

TEST(FrameKind, IsUniformWhereNothingMayBeSkipped) {
    const StringModel theta = bass(ImpactLaw::Newton, 48000, Scheme::Theta);
    expect_kinds(theta, make_string_state(theta), always(FrameKind::Uniform), "theta scheme");
    for (const StringModel* model : {&short_model(), &long_model()}) {
        expect_kinds(*model, make_string_state(*model, Metering::Step), always(FrameKind::Uniform),
                     "metering of steps");
        expect_kinds(*model, make_string_state(*model, Metering::Off, skip_nothing),
                     always(FrameKind::Uniform), "no skipping");
        Skipping no_certificate = skip_all;
        no_certificate.certificate = false;
        expect_kinds(*model, make_string_state(*model, Metering::Off, no_certificate),
                     always(FrameKind::Uniform), "no certificate");
    }
}

TEST(FrameKind, LongFramesFollowTheBroadPhase) {
    StringState state = make_string_state(long_model());
    const std::vector<std::optional<FrameKind>> expected{test_it, FrameKind::Planned, test_it,
                                                         FrameKind::Checked, FrameKind::NearInContactSpace};
    expect_kinds(long_model(), state, expected, "quiet");
    state.certificate.struck = true;
    state.certificate.backoff.left = 3;
    test::press(long_model(), state, 0.3, 1);
    expect_kinds(long_model(), state, expected, "struck and pressed");
    StringState stepped = make_string_state(long_model());
    stepped.skipping.near = false;
    EXPECT_EQ(choose_frame_kind(long_model(), stepped, Answer::MayClose), FrameKind::NearStepped);
    StringModel without_table = long_model();
    without_table.tuning.response = {};
    EXPECT_EQ(choose_frame_kind(without_table, state, Answer::MayClose), FrameKind::NearStepped);
    state.near_frame.crowded = true;
    EXPECT_EQ(choose_frame_kind(long_model(), state, Answer::MayClose), FrameKind::NearStepped);
}

TEST(FrameKind, ShortFramesAreSolvedWithoutATestWhereContactIsLikely) {
    StringState state = make_string_state(short_model());
    const std::vector<std::optional<FrameKind>> quiet{test_it, FrameKind::Planned, FrameKind::Short,
                                                      FrameKind::Checked, FrameKind::Short};
    std::vector<std::optional<FrameKind>> likely = quiet;
    likely[0] = FrameKind::Short;
    expect_kinds(short_model(), state, quiet, "quiet");
    state.certificate.backoff.left = 1;
    expect_kinds(short_model(), state, quiet, "backs off, but no force acts");
    test::press(short_model(), state, 0.3, 1);
    expect_kinds(short_model(), state, likely, "backs off under a force");
    state.certificate.backoff.left = 0;
    expect_kinds(short_model(), state, quiet, "tests under a force");
    state.certificate.struck = true;
    expect_kinds(short_model(), state, likely, "struck");
}

/// A string that is pressed against a fret: each failed test grants twice as many frames without one, up
/// to seven.
TEST(FrameKind, FailedTestsBackOff) {
    SceneDescription scene;
    scene.law = ImpactLaw::Signorini;
    scene.contact_rate_hz = 4 * 48000;
    scene.strings.push_back(test::bass_string(40));
    scene.strings[0].initial.shape = AtRest{};
    scene.strings[0].contacts[3].height_m = 0;
    const StringModel model = test::compiled_string(scene);
    ASSERT_TRUE(has_short_frames(model));
    StringState state = make_string_state(model);
    std::vector<std::uint32_t> granted;
    for (int n = 0; n < 400 && granted.size() < 5; ++n) {
        test::press(model, state, model.shape->contact_position[3], -0.4);
        state.certificate.struck = false;  // so that only the back-off decides
        const std::uint32_t left = state.certificate.backoff.left;
        advance_frame(model, state);
        if (left == 0 && state.certificate.backoff.left > 0) {
            granted.push_back(state.certificate.backoff.left);
        } else if (left > 0) {
            EXPECT_EQ(state.certificate.backoff.left, left - 1);
        }
    }
    EXPECT_EQ(granted, (std::vector<std::uint32_t>{1, 3, 7, 7, 7}));
}

}  // namespace
}  // namespace jawari
