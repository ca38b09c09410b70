// Pickups, the force on the bridge and the body against closed forms and fine numerical integration.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "instrument/voice/body.h"
#include "instrument/voice/pickups.h"
#include "instrument/voice/voice.h"
#include "jawari/instrument/compile.h"
#include "jawari/scene/modes.h"
#include "support/bass_instrument.h"
#include "support/small_instrument.h"

namespace jawari {
namespace {

constexpr double pi = std::numbers::pi;

InstrumentDescription open_string() {
    InstrumentDescription bass = test::bass_instrument();
    bass.strings.resize(1);
    bass.frets = {};
    return bass;
}

/// A body mode under a force that is linear between samples, by 2000 small steps of the midpoint rule each.
TEST(Body, FollowsAPiecewiseLinearForce) {
    InstrumentDescription instrument = open_string();
    instrument.gain = 1;
    instrument.body = {{.frequency_hz = 180, .t60_s = 0.2, .gain_left = 2, .gain_right = -3}};
    const BodyModel body = body_model(instrument, 48000);
    BodyState state = make_body_state(body);
    const double omega = 2 * pi * 180, sigma = std::log(1000.0) / 0.2;
    double y = 0, v = 0, before = 0;
    for (int n = 0; n < 400; ++n) {
        const double force = n < 100 ? std::sin(0.05 * n) : 0.3;
        const int steps = 2000;
        const double dt = 1 / 48000.0 / steps;
        for (int i = 0; i < steps; ++i) {
            const double F = before + (force - before) * (i + 0.5) / steps;
            const double a = F - 2 * sigma * v - omega * omega * y;
            const double v_mid = v + dt / 2 * a;
            const double y_mid = y + dt / 2 * v;
            v += dt * (F - 2 * sigma * v_mid - omega * omega * y_mid);
            y += dt * v_mid;
        }
        before = force;
        const StereoSample sample = advance_body(body, state, force);
        ASSERT_NEAR(sample.left, 2 * v, 1e-9) << n;
        ASSERT_NEAR(sample.right, -3 * v, 1e-9) << n;
    }
}

TEST(Body, ComesToRestAndIsRescuedFromNonsense) {
    InstrumentDescription instrument = open_string();
    instrument.body = {{.frequency_hz = 180, .t60_s = 0.05, .gain_left = 1, .gain_right = 1}};
    const BodyModel body = body_model(instrument, 48000);
    BodyState state = make_body_state(body);
    advance_body(body, state, 1);
    for (int n = 0; n < 48000 && state.ringing; ++n) advance_body(body, state, 0);
    EXPECT_FALSE(state.ringing);
    EXPECT_EQ(advance_body(body, state, 0).left, 0);
    EXPECT_EQ(advance_body(body, state, std::nan("")).left, 0);
    EXPECT_TRUE(std::isfinite(advance_body(body, state, 1).left));
}

/// The instrument's gain reaches pickups and body once, through the strings' level: twice the gain is twice
/// the sound to the last bit, and the body's own gains stay as described.
TEST(Body, CarriesTheGainOfTheInstrumentOnceOnly) {
    InstrumentDescription instrument = open_string();
    instrument.body = {{.frequency_hz = 180, .t60_s = 0.2, .gain_left = 2, .gain_right = -3}};
    const auto played = [&](double gain) {
        instrument.gain = gain;
        const InstrumentModel model = compile_instrument(instrument, 48000).value();
        EXPECT_EQ(model.body.gain_left[0], 2);
        EXPECT_EQ(model.body.gain_right[0], -3);
        InstrumentState state = make_instrument_state(model);
        return test::play(model, state, {note_on(0, 28, 0.5)}, 2000);
    };
    const auto once = played(0.25), twice = played(0.5);
    for (std::size_t n = 0; n < 2000; ++n) {
        ASSERT_EQ(twice.left[n], 2 * once.left[n]) << n;
        ASSERT_EQ(twice.right[n], 2 * once.right[n]) << n;
    }
    EXPECT_NE(once.left[1999], 0);
}

/// The body is linear: what each string alone drives it to adds up to what all drive it to.
TEST(Body, OutputsOfStringsAddUpToTheMonoSound) {
    InstrumentDescription instrument = test::bass_instrument();
    instrument.frets = {};
    instrument.pickups.clear();
    instrument.body = {{.frequency_hz = 180, .t60_s = 0.2, .gain_left = 2, .gain_right = -1},
                       {.frequency_hz = 400, .t60_s = 0.1, .gain_left = 0.5, .gain_right = 1.5}};
    const InstrumentModel model = compile_instrument(instrument, 48000).value();
    InstrumentState state = make_instrument_state(model);
    const std::size_t frames = 3000;
    std::vector<double> left(frames), right(frames);
    std::vector<std::vector<double>> each(model.strings.size(), std::vector<double>(frames));
    std::vector<double*> strings;
    for (auto& string : each) strings.push_back(string.data());
    const std::vector<InstrumentEvent> events{note_on(0, 28, 0.7), note_on(500, 38, 0.9),
                                              note_off(2000, 28, 0.5)};
    render_instrument(model, state, events, InstrumentOutput{left.data(), right.data(), strings}, frames);
    double largest = 0;
    for (std::size_t n = 0; n < frames; ++n) {
        const double sum = each[0][n] + each[1][n] + each[2][n] + each[3][n];
        largest = std::max(largest, std::abs(each[0][n]));
        ASSERT_NEAR(sum, (left[n] + right[n]) / 2, 1e-12) << n;
        ASSERT_EQ(each[1][n], 0) << n;
    }
    EXPECT_GT(largest, 1e-3);
}

/// A triangle of height a at x_p exerts T a/(L - x_p) on the bridge: what its modes add up to.
TEST(Pickup, BridgeForceIsTensionTimesSlope) {
    InstrumentDescription instrument = open_string();
    instrument.strings[0].inharmonicity = 0;
    instrument.quality = {.contact_rate_min_hz = 2e6, .mode_limit_hz = 60000};
    instrument.body = {{.frequency_hz = 100, .t60_s = 1, .gain_left = 1, .gain_right = 1}};
    const InstrumentModel model = compile_instrument(instrument, 192000).value();
    const StoppedStringModel& stopped = model.strings[0].stopped[0];
    Voice voice = make_voice(model.strings[0].sizes);
    start_voice(model, model.strings[0], voice, 0, 0, 0);
    const Pluck triangle{.position_m = 0.5, .height_m = 1e-3};
    for (std::size_t k = 0; k < stopped.string.shape->mode_count; ++k)
        voice.string.displacement[k] = pluck_coordinate(k + 1, triangle, stopped.string.shape->length_m);
    voice.string.active_modes = stopped.string.shape->stride;
    const double L = stopped.string.shape->length_m;
    const double tension = 4 * L * L * 41.20344461410875 * 41.20344461410875 * 0.0354;
    const double slope = 1e-3 / (L - 0.5);
    OutputReadings readings;
    set_output_readings(model, stopped, readings);
    read_outputs(voice.string, 0, readings);
    EXPECT_NEAR(bridge_force(stopped, readings, 0), tension * slope, 3e-3 * tension * slope);
}

TEST(Pickup, QuantitiesMixAndMagnet) {
    InstrumentDescription instrument = open_string();
    instrument.pickups = {{.place = {.share = 0.2}, .level = 2},
                          {.place = {.share = 0.3}, .level = 5, .quantity = PickupQuantity::Displacement},
                          {.place = {.share = 0.2}, .level = 1, .magnet_distance_m = 0.004}};
    const InstrumentModel model = compile_instrument(instrument, 48000).value();
    const StoppedStringModel& stopped = model.strings[0].stopped[0];
    Voice voice = make_voice(model.strings[0].sizes);
    start_voice(model, model.strings[0], voice, 0, 0, 0);
    voice.string.displacement[0] = 1e-3;
    voice.string.velocity[0] = 0.7;
    const double L = stopped.string.shape->length_m;
    const double near = mode_shape(1, 0.8 * L, L), far = mode_shape(1, 0.7 * L, L);
    const double gap = 1 - 1e-3 * near / 0.004;
    const double first = 2 * 0.7 * near;
    const double second = 5 * 1e-3 * far;
    const double third = 0.7 * near / (gap * gap * gap);
    OutputReadings readings;
    set_output_readings(model, stopped, readings);
    read_outputs(voice.string, 0, readings);
    EXPECT_NEAR(pickup_signal(model, stopped, readings, 0, 0.5), first + second + third, 1e-12);
    EXPECT_NEAR(pickup_signal(model, stopped, readings, 0, 0), first, 1e-12);
    EXPECT_NEAR(pickup_signal(model, stopped, readings, 0, 1), second + third, 1e-12);
}

/// A low pass of second order: |H| = 1/|1 - r^2 + i r/Q|, r = f/f0; its level is Q at f0, and 1 far below.
TEST(Pickup, ACoilWeighsEachPartialAtItsFrequency) {
    InstrumentDescription instrument = open_string();
    instrument.pickups = {{.place = {.share = 0.13}},
                          {.place = {.share = 0.13}, .resonance_hz = 400, .quality_factor = 3}};
    const InstrumentModel model = compile_instrument(instrument, 48000).value();
    const StoppedStringModel& stopped = model.strings[0].stopped[0];
    Voice voice = make_voice(model.strings[0].sizes);
    start_voice(model, model.strings[0], voice, 0, 0, 0);
    for (const std::size_t k : {1U, 5U, 9U, 10U, 40U}) {
        voice.string.velocity[k - 1] = 1;
        OutputReadings readings;
        set_output_readings(model, stopped, readings);
        read_outputs(voice.string, 0, readings);
        const double plain = pickup_signal(model, stopped, readings, 0, 0);
        const double heard = pickup_signal(model, stopped, readings, 0, 1);
        voice.string.velocity[k - 1] = 0;
        const double n = static_cast<double>(k);
        const double f = n * 41.20344461410875 * std::sqrt((1 + 9e-5 * n * n) / (1 + 9e-5));
        const double re = 1 - f * f / 160000, im = f / 400 / 3;
        EXPECT_NEAR(heard / plain, 1 / std::sqrt(re * re + im * im), 1e-9) << k;
    }
}

/// What a pan does to one and the same note.
test::Played panned(const InstrumentModel& model, double pan) {
    InstrumentState state = make_instrument_state(model);
    const InstrumentEvent turn = set_parameter(0, ParameterId::Pan, pan);
    return test::play(model, state, {turn, note_on(0, 28, 0.5)}, 6000);
}

double power_of(const std::vector<double>& x) {
    return std::inner_product(x.begin() + 3000, x.end(), x.begin() + 3000,
                              0.0);  // after controls have glided
}

TEST(Pan, IsFromLeftToRightWithConstantPower) {
    const InstrumentModel model = compile_instrument(open_string(), 48000).value();
    const test::Played middle = panned(model, 0);
    const double power = power_of(middle.left) + power_of(middle.right);
    ASSERT_GT(power, 0);
    EXPECT_NEAR(power_of(middle.left), power_of(middle.right), 1e-9 * power);
    for (const double pan : {-1.0, -0.6, -0.2, 0.3, 0.8, 1.0}) {
        const test::Played there = panned(model, pan);
        const double left = power_of(there.left);
        const double right = power_of(there.right);
        EXPECT_NEAR(left + right, power, 1e-6 * power) << pan;
        EXPECT_GT((right - left) * pan, 0) << pan;
        if (std::abs(pan) == 1) {
            EXPECT_LT(std::min(left, right), 1e-9 * power);
        }
    }
}

/// A note with an event of its own at frame 0, and the same note again afterwards.
struct TwoNotes {
    test::Played first, second;
};

TwoNotes played_with(const InstrumentModel& model, std::vector<InstrumentEvent> own) {
    InstrumentState state = make_instrument_state(model);
    own.insert(own.begin(), note_on(0, 28, 0.5));
    TwoNotes notes;
    notes.first = test::play(model, state, own, 6000);
    test::play(model, state, {all_sound_off(0)}, 6000);
    notes.second = test::play(model, state, {note_on(0, 28, 0.5)}, 6000);
    return notes;
}

double power_of(const test::Played& played) {
    return power_of(played.left) + power_of(played.right);
}

TEST(NoteLevel, IsAFactorOfOneNote) {
    const InstrumentModel model = compile_instrument(open_string(), 48000).value();
    const TwoNotes plain = played_with(model, {});
    ASSERT_GT(power_of(plain.first), 0);
    for (const double level : {0.5, 2.0, most_note_level}) {
        const TwoNotes scaled = played_with(model, {set_note_level(0, 28, level)});
        EXPECT_NEAR(power_of(scaled.first), level * level * power_of(plain.first),
                    1e-6 * power_of(scaled.first));
        EXPECT_NEAR(power_of(scaled.second), power_of(plain.second), 1e-9 * power_of(plain.second)) << level;
    }
    EXPECT_LT(power_of(played_with(model, {set_note_level(0, 28, 0)}).first), 1e-9 * power_of(plain.first));
}

TEST(NotePan, IsAddedToThePlaceOfOneNote) {
    const InstrumentModel model = compile_instrument(open_string(), 48000).value();
    for (const double pan : {-1.0, -0.4, 0.7}) {
        const TwoNotes moved = played_with(model, {set_note_pan(0, 28, pan)});
        const test::Played expected = panned(model, pan);
        EXPECT_NEAR(power_of(moved.first.left), power_of(expected.left), 1e-6 * power_of(expected)) << pan;
        EXPECT_NEAR(power_of(moved.first.right), power_of(expected.right), 1e-6 * power_of(expected)) << pan;
        EXPECT_NEAR(power_of(moved.second.left), power_of(moved.second.right), 1e-9 * power_of(moved.second));
    }
}

TEST(NoteLevel, OtherNotesAndImpossibleValuesAreLeftAlone) {
    const InstrumentModel model = compile_instrument(open_string(), 48000).value();
    const TwoNotes plain = played_with(model, {});
    const TwoNotes odd = played_with(
        model, {set_note_level(0, 29, 0.1), set_note_level(0, 28, 0.1, 3), set_note_level(0, 28, -0.1),
                set_note_level(0, 28, 4.1), set_note_level(0, 28, std::nan("")), set_note_pan(0, 28, 1.5),
                set_note_pan(0, 28, std::nan("")), set_note_pan(0, every_key, 1)});
    EXPECT_EQ(odd.first.left, plain.first.left);
    EXPECT_EQ(odd.first.right, plain.first.right);
}

}  // namespace
}  // namespace jawari
