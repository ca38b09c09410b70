// Resolutions follow the demand, and descriptions are cut as told. Errors:
// tests/host/instrument/quality_test.cpp.
#include "jawari/scene/resolution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"

namespace jawari {
namespace {

SceneDescription bass() {
    SceneDescription scene;
    scene.strings.push_back(test::bass_string(862));
    return scene;
}

TEST(Quality, ResolutionRisesWithTheDemandAndIsAMultipleOfTheOutputRate) {
    for (const double output_rate_hz : {44100.0, 48000.0, 96000.0}) {
        Resolution coarser{0, 0};
        for (const double error : {0.5, 0.2, 0.1, 0.05, 0.01, 1e-3, 1e-4}) {
            const Resolution finer = resolution_for(error, output_rate_hz);
            EXPECT_GE(finer.mode_limit_hz, coarser.mode_limit_hz);
            const double steps = finer.contact_rate_hz / output_rate_hz;
            EXPECT_EQ(steps, std::round(steps));
            EXPECT_GE(steps, 1);
            coarser = finer;
        }
        EXPECT_GE(coarser.contact_rate_hz, 0.0095e6 / 1e-4);
    }
}

/// Errors of contact fall as the contact rate rises, and add as squares to those of missing modes: two
/// demands that keep the same modes must agree on what is missing.
TEST(Quality, TheContactRatePaysForModesThatAreMissing) {
    const double fine_hz = 1000;  // so that whole steps round the rates by little
    const double error_times_rate = 1e-4 * resolution_for(1e-4, fine_hz).contact_rate_hz;  // with all modes
    for (const double error : {0.08, 0.25, 0.6}) {
        const Resolution strict = resolution_for(error, fine_hz);
        const Resolution easy = resolution_for(1.1 * error, fine_hz);
        ASSERT_EQ(strict.mode_limit_hz, easy.mode_limit_hz);
        const auto missing = [&](double whole, const Resolution& resolution) {
            const double of_contact = error_times_rate / resolution.contact_rate_hz;
            return std::sqrt(whole * whole - of_contact * of_contact);
        };
        EXPECT_NEAR(missing(error, strict), missing(1.1 * error, easy), 0.01 * error);
        EXPECT_GT(missing(error, strict), 0.5 * error);
    }
}

TEST(Quality, ModesAreCutAtTheLimitWhateverTheirForm) {
    const double limit_hz = resolution_for(error_target(Quality::Live), 48000).mode_limit_hz;
    SceneDescription scene = bass();
    StringDescription table;
    table.length_m = 1;
    table.linear_density_kg_per_m = 0.01;
    table.modes = ModeTable{{100, limit_hz - 1, limit_hz + 1}, {1, 2, 3}};
    table.initial.shape = ModalState{{1e-3, 1e-4, 1e-5}, {}};
    scene.strings.push_back(table);
    const SceneDescription cut = at_quality(scene, Quality::Live);
    const Modes bass_modes = modes_of(cut.strings[0]);
    const Modes all = modes_of(scene.strings[0]);
    EXPECT_LE(bass_modes.omega.back(), 2 * 3.14159265358979 * limit_hz);
    EXPECT_GT(all.omega[bass_modes.omega.size()], 2 * 3.14159265358979 * limit_hz);
    EXPECT_EQ(std::get<ModeTable>(cut.strings[1].modes).frequency_hz.size(), 2U);
    EXPECT_EQ(std::get<ModalState>(cut.strings[1].initial.shape).displacement.size(), 2U);
    EXPECT_TRUE(compile(cut));
}

TEST(Quality, KeepingMoreModesThanThereAreChangesNothing) {
    StringDescription table;
    table.modes = ModeTable{{100, 200, 300}, {1, 2, 3}};
    table.initial.shape = ModalState{{}, {1, 2, 3}};
    keep_modes(table, 5);
    EXPECT_EQ(std::get<ModeTable>(table.modes).decay_per_s.size(), 3U);
    keep_modes(table, 2);
    EXPECT_EQ(std::get<ModeTable>(table.modes).frequency_hz, (std::vector<double>{100, 200}));
    EXPECT_EQ(std::get<ModeTable>(table.modes).decay_per_s, (std::vector<double>{1, 2}));
    EXPECT_TRUE(std::get<ModalState>(table.initial.shape).displacement.empty());
    EXPECT_EQ(std::get<ModalState>(table.initial.shape).velocity, (std::vector<double>{1, 2}));
    StringDescription physical = bass().strings[0];
    keep_modes(physical, 1000);
    EXPECT_EQ(modes_of(physical).omega.size(), 862U);
}

/// The inverse of resolution_for() where no mode is missing, and the same number of steps a period has the
/// same error whatever the pitch.
TEST(Quality, ContactErrorsFallWithTheRateAndRiseWithThePitch) {
    const double bass_hz = 97.97;
    const double rate_hz = resolution_for(1e-4, 1).contact_rate_hz;
    EXPECT_NEAR(contact_error(bass_hz, rate_hz), 1e-4, 1e-9);
    EXPECT_DOUBLE_EQ(contact_error(bass_hz, 2e6), 2 * contact_error(bass_hz, 4e6));
    EXPECT_DOUBLE_EQ(contact_error(3 * bass_hz, 3e6), contact_error(bass_hz, 1e6));
}

}  // namespace
}  // namespace jawari
