#include "jawari/instrument/qualities.h"
#include "jawari/instrument/compile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "instrument/voice/voice.h"
#include "support/small_instrument.h"

namespace jawari {
namespace {

using test::Played;
using test::small_instrument;

constexpr double rate_hz = 48000;

InstrumentModel with_qualities(const InstrumentDescription& instrument,
                               std::vector<QualityDescription> lower) {
    InstrumentModel model = compile_instrument(instrument, rate_hz).value();
    const auto failure = add_qualities(model, instrument, lower);
    EXPECT_FALSE(failure) << failure->line();
    return model;
}

std::vector<InstrumentEvent> chord(const InstrumentModel& model) {
    std::vector<InstrumentEvent> events;
    for (const InstrumentStringModel& string : model.strings)
        events.push_back(note_on(0, string.stopped.front().key, 0.9));
    return events;
}

double largest(const std::vector<double>& x) {
    double most = 0;
    for (const double value : x) most = std::max(most, std::abs(value));
    return most;
}

/// True energy 1/2 mu (u^2 + omega^2 q^2) of all motions, which no step size enters.
double true_energy(const InstrumentModel& model, const InstrumentState& state) {
    double sum = 0;
    for (std::size_t s = 0; s < state.strings.size(); ++s) {
        const InstrumentStringModel& string = string_of(model, state, s);
        for (const Voice& voice : state.strings[s].voices) {
            if (voice.phase == VoicePhase::Idle || voice.bend.active) continue;
            const StoppedStringModel& stopped = string.stopped[voice.fret];
            for (std::size_t k = 0; k < stopped.string.shape->mode_count; ++k) {
                const double q = voice.string.displacement[k] - stopped.string.shape->rest_displacement[k];
                const double u =
                    (voice.string.velocity[k] - stopped.backward_q[k] * q) / stopped.backward_u[k];
                const double w = stopped.string.tuning.omega[k];
                sum += 0.5 * stopped.string.shape->linear_density_kg_per_m * (u * u + w * w * q * q);
            }
        }
    }
    return sum;
}

/// A quality level that is no lower changes nothing but the last bits: bent, damped, touched motions
/// included.
TEST(InstrumentQualities, AChangeToTheSameQualityIsNotHeard) {
    InstrumentDescription instrument = small_instrument();
    instrument.contacts = false;  // contacts would amplify the last bits
    const InstrumentModel model = with_qualities(instrument, {instrument.quality});
    const auto events = test::storm(11, 9000, 60);
    InstrumentState plain = make_instrument_state(model);
    InstrumentState changed = make_instrument_state(model);
    double difference = 0;
    double loudest = 0;
    std::size_t changes = 0;
    for (std::size_t block = 0; block < 9000 / 100; ++block) {
        std::vector<InstrumentEvent> here;
        for (InstrumentEvent event : events) {
            if (event.frame / 100 != block) continue;
            event.frame %= 100;
            here.push_back(event);
        }
        const Played a = test::play(model, plain, here, 100);
        const Played b = test::play(model, changed, here, 100);
        for (std::size_t n = 0; n < 100; ++n)
            difference = std::max(difference, std::abs(a.left[n] - b.left[n]));
        loudest = std::max(loudest, largest(a.left));
        if (block % 5 != 4) continue;
        for (std::size_t s = 0; s < model.strings.size(); ++s)
            change_quality(model, changed, s, (block / 5) % 2);
        ++changes;
    }
    EXPECT_EQ(changes, 18U);
    EXPECT_GT(loudest, 0);
    EXPECT_LT(difference, 1e-9 * loudest);
    EXPECT_NEAR(changed.work.quality_changes_J, 0, 1e-12 * (1 + std::abs(changed.work.exciters_J)));
}

/// Without contacts modes do not know of each other: what is left is what the lower instrument has from the
/// start.
TEST(InstrumentQualities, TheModesThatStayGoOnAsTheyWere) {
    InstrumentDescription instrument = small_instrument();
    instrument.strings = {instrument.strings[2]};
    instrument.obstacles.clear();
    instrument.body.clear();
    instrument.contacts = false;
    for (ExciterDescription& exciter : instrument.exciters) {
        if (auto* finger = std::get_if<FingerDescription>(&exciter.body)) finger->damping_kg_per_s = 0;
    }
    instrument.soft_touches.clear();
    for (PickupDescription& pickup : instrument.pickups) pickup.magnet_distance_m = 0;  // not linear
    QualityDescription lower = instrument.quality;
    lower.mode_limit_hz = 0.4 * instrument.quality.mode_limit_hz;
    const InstrumentModel model = with_qualities(instrument, {lower});
    const auto play_on = [&](std::size_t before, std::size_t after) {
        InstrumentState state = make_instrument_state(model);
        change_quality(model, state, 0, before);
        // Calibrated forces know of the modes; the motion does not.
        std::vector<InstrumentEvent> note{note_on_string(0, 0, model.strings[0].stopped[0].key, 0.5)};
        test::play(model, state, note, 2000);
        change_quality(model, state, 0, after);
        return test::play(model, state, {}, 3000).left;
    };
    const std::vector<double> from_full = play_on(0, 1);
    const std::vector<double> from_start = play_on(1, 1);
    const double force =
        model.strings[0].stopped[0].full_force_N[0] / model.lower[0][0].stopped[0].full_force_N[0];
    ASSERT_GT(largest(from_start), 0);
    // What the modes that are left out gave to the outputs fades first.
    for (std::size_t n = model.fade_shape.size(); n < from_full.size(); ++n)
        ASSERT_NEAR(from_full[n], force * from_start[n], 1e-9 * largest(from_start)) << n;
}

/// The exact scheme samples free motion exactly at any step: displacement does not know of the contact rate,
/// if the velocity has been converted rightly.
TEST(InstrumentQualities, AnotherContactRateGoesOnWithTheSameMotion) {
    InstrumentDescription instrument = small_instrument();
    instrument.strings = {instrument.strings[2]};
    instrument.obstacles.clear();
    instrument.body.clear();
    instrument.soft_touches.clear();
    instrument.contacts = false;
    for (PickupDescription& pickup : instrument.pickups) pickup.quantity = PickupQuantity::Displacement;
    QualityDescription slower = instrument.quality;
    slower.contact_rate_min_hz /= 4;
    slower.mode_limit_hz = instrument.quality.mode_limit_hz;
    const InstrumentModel model = with_qualities(instrument, {slower});
    ASSERT_NE(model.lower[0][0].stopped[0].string.shape->step_s,
              model.strings[0].stopped[0].string.shape->step_s);
    std::vector<double> sounds[2];
    for (const bool changed : {false, true}) {
        InstrumentState state = make_instrument_state(model);
        const std::vector<InstrumentEvent> events{note_on(0, model.strings[0].stopped[1].key, 0.8)};
        test::play(model, state, events, 2000);
        if (changed) change_quality(model, state, 0, 1);
        sounds[changed] = test::play(model, state, {}, 4000).left;
    }
    for (std::size_t n = 0; n < sounds[0].size(); ++n)
        ASSERT_NEAR(sounds[0][n], sounds[1][n], 1e-9 * largest(sounds[0])) << n;
}

TEST(InstrumentQualities, NoChangeAddsEnergy) {
    const InstrumentDescription instrument = small_instrument();
    QualityDescription half = instrument.quality, fifth = instrument.quality;
    half.contact_rate_min_hz /= 2;
    half.mode_limit_hz /= 2;
    fifth.contact_rate_min_hz = half.contact_rate_min_hz;
    fifth.mode_limit_hz /= 5;
    const InstrumentModel model = with_qualities(instrument, {half, fifth});
    InstrumentState state = make_instrument_state(model);
    test::play(model, state, chord(model), 1500);
    for (const std::size_t quality_level : {1UL, 2UL, 0UL, 2UL, 1UL, 0UL}) {
        const double before = true_energy(model, state);
        double metered = state.work.quality_changes_J;
        double discrete = 0;
        for (std::size_t s = 0; s < model.strings.size(); ++s) discrete -= string_energy(model, state, s);
        for (std::size_t s = 0; s < model.strings.size(); ++s) change_quality(model, state, s, quality_level);
        for (std::size_t s = 0; s < model.strings.size(); ++s) discrete += string_energy(model, state, s);
        metered = state.work.quality_changes_J - metered;
        EXPECT_GT(before, 0);
        EXPECT_LE(true_energy(model, state), before * (1 + 1e-12)) << quality_level;
        EXPECT_NEAR(metered, discrete, 1e-9 * before) << quality_level;
        test::play(model, state, {}, 700);
    }
}

TEST(InstrumentQualities, OutOfRangeIsIgnoredAndIdleStringsJustChange) {
    const InstrumentDescription instrument = small_instrument();
    const InstrumentModel model = with_qualities(instrument, {instrument.quality});
    InstrumentState state = make_instrument_state(model);
    change_quality(model, state, 0, 2);
    EXPECT_EQ(state.strings[0].quality_level, 0U);
    change_quality(model, state, 0, 1);
    EXPECT_EQ(state.strings[0].quality_level, 1U);
    EXPECT_EQ(state.work.quality_changes_J, 0);
}

TEST(InstrumentQualities, TheOldestReleasedMotionFadesFirst) {
    const InstrumentModel model = compile_instrument(small_instrument(), rate_hz).value();
    InstrumentState state = make_instrument_state(model);
    EXPECT_FALSE(fade_oldest_released(state));
    std::vector<InstrumentEvent> events = chord(model);
    for (std::size_t i = 0; i < events.size(); ++i) events[i].frame = 10 * i;
    test::play(model, state, events, 200);
    EXPECT_FALSE(fade_oldest_released(state));  // all are held
    for (InstrumentEvent& event : events) event = note_off(0, event.key);
    test::play(model, state, events, 1);
    ASSERT_TRUE(fade_oldest_released(state));
    EXPECT_TRUE(state.strings[0].voices[0].fading);
    EXPECT_FALSE(state.strings[1].voices[0].fading);
    EXPECT_EQ(state.counters.faded_voices, 1U);
}

}  // namespace
}  // namespace jawari
