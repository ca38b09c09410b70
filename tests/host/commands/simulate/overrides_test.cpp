#include "commands/simulate/overrides.h"

#include <gtest/gtest.h>

#include "formats/scene/read_scene.h"
#include "jawari/scene/compile.h"
#include "support/scene_text.h"

namespace jawari::host {
namespace {

Scene scene_with(const Overrides& overrides) {
    auto scene = read_scene(test::valid_scene, "f.json");
    EXPECT_TRUE(scene);
    EXPECT_FALSE(apply_overrides(overrides, scene.value()));
    return scene.value();
}

std::string failure_with(const Overrides& overrides, ErrorKind& kind) {
    const Scene scene = scene_with(overrides);
    const auto model = compile(scene.description);
    if (model) return "none";
    const Error error = explain(model.failure(), overrides, scene);
    kind = error.kind;
    return error.message;
}

TEST(Overrides, NothingGivenChangesNothing) {
    const Scene scene = scene_with({});
    EXPECT_EQ(scene.description.contact_rate_hz, 80000);
    EXPECT_EQ(scene.description.law, ImpactLaw::Newton);
    EXPECT_EQ(scene.description.strings[0].contacts[0].restitution, 0.5);
    EXPECT_EQ(scene.description.strings[0].contacts[1].restitution, 0);
}

TEST(Overrides, EachReplacesTheValueOfTheFile) {
    Overrides overrides;
    overrides.output_rate_hz = 1000;
    overrides.contact_rate_hz = 5000;
    overrides.duration_s = 2;
    overrides.scheme = Scheme::Theta;
    overrides.theta = 0.75;
    overrides.law = ImpactLaw::Passive;
    overrides.restitution = 0.25;
    overrides.start = Start::Backward;
    const Scene scene = scene_with(overrides);
    EXPECT_EQ(scene.description.output_rate_hz, 1000);
    EXPECT_EQ(scene.description.contact_rate_hz, 5000);
    EXPECT_EQ(scene.duration_s, 2);
    EXPECT_EQ(scene.description.scheme, Scheme::Theta);
    EXPECT_EQ(scene.description.theta, 0.75);
    EXPECT_EQ(scene.description.law, ImpactLaw::Passive);
    for (const auto& contact : scene.description.strings[0].contacts) EXPECT_EQ(contact.restitution, 0.25);
    EXPECT_EQ(scene.description.strings[0].initial.start, Start::Backward);
}

TEST(Overrides, ThetaNeedsTheThetaScheme) {
    auto scene = read_scene(test::valid_scene, "f.json");
    Overrides overrides;
    overrides.theta = 0.7;
    const auto error = apply_overrides(overrides, scene.value());
    ASSERT_TRUE(error);
    EXPECT_EQ(error->kind, ErrorKind::Usage);
    EXPECT_EQ(error->message, "--theta: 0.7 (allowed: only together with --scheme theta)");
}

TEST(Overrides, RatesThatDoNotFitNameTheNearestContactRate) {
    ErrorKind kind{};
    Overrides contact;
    contact.contact_rate_hz = 100001;
    EXPECT_EQ(failure_with(contact, kind),
              "--contact-rate: 100001 (allowed: an integer multiple of the output rate 8000, the nearest "
              "being 104000)");
    EXPECT_EQ(kind, ErrorKind::Usage);
    Overrides output;
    output.output_rate_hz = 44100;
    EXPECT_EQ(failure_with(output, kind),
              "--output-rate: 44100 (allowed: a rate that divides contact_rate_hz 80000 of f.json, or "
              "together with "
              "--contact-rate 88200)");
    EXPECT_EQ(kind, ErrorKind::Usage);
}

TEST(Overrides, FailuresNameWhicheverSaidIt) {
    ErrorKind kind{};
    Overrides scheme;
    scheme.scheme = Scheme::Theta;
    scheme.law = ImpactLaw::Passive;
    EXPECT_EQ(failure_with(scheme, kind),
              "--law: passive (allowed: newton, the only law of the theta scheme)");
    EXPECT_EQ(kind, ErrorKind::Usage);

    auto passive = read_scene(test::replaced(test::valid_scene, "newton", "passive"), "f.json");
    scheme.law.reset();
    ASSERT_FALSE(apply_overrides(scheme, passive.value()));
    const auto model = compile(passive.value().description);
    ASSERT_FALSE(model);
    EXPECT_TRUE(explain(model.failure(), scheme, passive.value()).message.starts_with("--scheme: theta"));
}

}  // namespace
}  // namespace jawari::host
