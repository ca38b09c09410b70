// Playing with everything: clicks, harmonics, release, legato, courses, modes of play, storms of events.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "instrument/voice/voice.h"
#include "jawari/instrument/compile.h"
#include "support/small_instrument.h"

namespace jawari {
namespace {

using test::play;
using test::Played;

constexpr double pi = std::numbers::pi;

const InstrumentModel& small_model() {
    static const InstrumentModel model = compile_instrument(test::small_instrument(), 48000).value();
    return model;
}

/// One bass string, clear of everything it could strike.
const InstrumentModel& free_model() {
    static const InstrumentModel model = [] {
        InstrumentDescription bass = test::bass_instrument();
        bass.strings = {bass.strings[1]};
        bass.frets.count = 7;
        bass.frets.height_m.clear();
        bass.quality.mode_limit_hz = 6000;
        return compile_instrument(bass, 48000).value();
    }();
    return model;
}

std::vector<double> mono(const InstrumentModel& model, const std::vector<InstrumentEvent>& events,
                         std::size_t frames) {
    InstrumentState state = make_instrument_state(model);
    return play(model, state, events, frames).left;
}

/// Largest |x[n+1] - 2 x[n] + x[n-1]| for n in [begin, end).
double sharpest(const std::vector<double>& x, std::size_t begin, std::size_t end) {
    double most = 0;
    for (std::size_t n = begin; n < end; ++n) most = std::max(most, std::abs(x[n + 1] - 2 * x[n] + x[n - 1]));
    return most;
}

/// Amplitude at a frequency, Hann-windowed.
double level_at(const std::vector<double>& x, std::size_t begin, std::size_t frames, double hz) {
    double re = 0, im = 0;
    for (std::size_t n = 0; n < frames; ++n) {
        const double w = 0.5 - 0.5 * std::cos(2 * pi * static_cast<double>(n) / static_cast<double>(frames));
        const double a = 2 * pi * hz * static_cast<double>(n) / 48000;
        re += w * x[begin + n] * std::cos(a);
        im += w * x[begin + n] * std::sin(a);
    }
    return 4 * std::hypot(re, im) / static_cast<double>(frames);
}

/// Frequency near `hz` from the phase advance between two windows.
double frequency_near(const std::vector<double>& x, std::size_t begin, double hz) {
    const auto phase = [&](std::size_t from) {
        double re = 0, im = 0;
        const std::size_t frames = 9600;
        for (std::size_t n = 0; n < frames; ++n) {
            const double w =
                0.5 - 0.5 * std::cos(2 * pi * static_cast<double>(n) / static_cast<double>(frames));
            const double a = 2 * pi * hz * static_cast<double>(from + n) / 48000;
            re += w * x[from + n] * std::cos(a);
            im -= w * x[from + n] * std::sin(a);
        }
        return std::atan2(im, re);
    };
    const double turned = std::remainder(phase(begin + 2400) - phase(begin), 2 * pi);
    return hz + turned / (2 * pi) * 48000 / 2400;
}

// ---------------------------------------------------------------------------------------------- clicks

struct Change {
    const char* name;
    std::vector<InstrumentEvent> events;
};

class NoClick : public testing::TestWithParam<Change> {};

/// A note of a free string rings; what happens at frame 9600 leaves its second difference below twice that of
/// the same passage without it, the attack of any new note apart.
TEST_P(NoClick, AroundTheChange) {
    std::vector<InstrumentEvent> events{note_on(0, 33, 0.6)};
    const auto without = mono(free_model(), events, 14400);
    events.insert(events.end(), GetParam().events.begin(), GetParam().events.end());
    const auto with = mono(free_model(), events, 14400);
    EXPECT_NE(with, without);
    EXPECT_LE(sharpest(with, 9500, 14300), 2 * sharpest(without, 9500, 14300)) << GetParam().name;
}

INSTANTIATE_TEST_SUITE_P(
    Changes, NoClick,
    testing::Values(Change{"note off", {note_off(9600, 33)}},
                    Change{"hard note off", {note_off(9600, 33, 1)}},
                    Change{"bend up", {bend_channel(9600, 2)}}, Change{"bend down", {bend_channel(9600, -2)}},
                    Change{"bend and back", {bend_channel(9600, 1), bend_channel(9800, 0)}},
                    Change{"vibrato", {set_parameter(9600, ParameterId::VibratoDepth, 0.5)}},
                    Change{"palm", {set_parameter(9600, ParameterId::PalmMute, 1)}},
                    Change{"palm and off",
                           {set_parameter(9600, ParameterId::PalmMute, 0.5),
                            set_parameter(10600, ParameterId::PalmMute, 0)}},
                    Change{"volume", {set_parameter(9600, ParameterId::Volume, 0.2)}},
                    Change{"slide",
                           {set_parameter(9500, ParameterId::Legato, 1),
                            set_parameter(9500, ParameterId::SlideTime, 0.03), note_on(9600, 36, 0.6)}},
                    Change{"all sound off", {all_sound_off(9600)}}),
    [](const auto& change) {
        std::string name = change.param.name;
        for (char& c : name) c = c == ' ' ? '_' : c;
        return name;
    });

/// Hammer-ons and pull-offs bring new sound: compared with the note plucked at the new fret as hard.
TEST(Legato, DoesNotClick) {
    for (const int to : {35, 40}) {
        const std::vector<InstrumentEvent> up{set_parameter(0, ParameterId::Legato, 1), note_on(0, 33, 0.6),
                                              note_on(9600, to, 0.6)};
        const auto first = mono(free_model(), {note_on(0, 33, 0.6)}, 14400);
        const auto second = mono(free_model(), {note_on(9600, to, 0.6)}, 14400);
        const auto legato = mono(free_model(), up, 14400);
        EXPECT_LE(sharpest(legato, 9500, 14300),
                  2 * std::max(sharpest(first, 9500, 14300), sharpest(second, 9500, 14300)));
        const std::vector<InstrumentEvent> down{set_parameter(0, ParameterId::Legato, 1), note_on(0, to, 0.6),
                                                note_on(9600, 33, 0.6)};
        const auto other = mono(free_model(), {note_on(0, to, 0.6)}, 14400);
        const auto pulled = mono(free_model(), down, 14400);
        EXPECT_LE(sharpest(pulled, 9500, 14300),
                  2 * std::max(sharpest(other, 9500, 14300), sharpest(first, 9500, 14300)));
    }
}

// ---------------------------------------------------------------------------------------------- pitch

TEST(Pitch, BendsAndSlidesArriveWhereTheyShould) {
    const double A = 55;
    const auto cents = [](double a, double b) { return 1200 * std::log2(a / b); };
    const auto bent = mono(free_model(), {note_on(0, 33, 0.3), bend_channel(100, 1.5)}, 24000);
    const double up = A * std::exp2(1.5 / 12);
    EXPECT_NEAR(cents(frequency_near(bent, 9600, up), up), 0, 0.3);
    const auto slid =
        mono(free_model(),
             {set_parameter(0, ParameterId::Legato, 1), set_parameter(0, ParameterId::SlideTime, 0.1),
              note_on(0, 33, 0.3), note_on(1000, 38, 0.3)},
             24000);
    const double fifth = A * std::exp2(5.0 / 12);
    EXPECT_NEAR(cents(frequency_near(slid, 9600, fifth), fifth), 0, 0.3);
    const auto hammered =
        mono(free_model(),
             {set_parameter(0, ParameterId::Legato, 1), note_on(0, 33, 0.3), note_on(1000, 38, 0.3)}, 24000);
    EXPECT_NEAR(cents(frequency_near(hammered, 9600, fifth), fifth), 0, 0.3);
}

/// 20 lg of the closing level of a slide from key to key over that of the same key played once; and the work
/// of the transfer.
struct SlideEnd {
    double level_db = 0;
    double transfer_J = 0;
    double energy_J = 0;
};

SlideEnd slide_end(int from, int to) {
    InstrumentDescription bass = test::bass_instrument();
    bass.strings = {bass.strings[1]};
    bass.strings[0].damping = NoLoss{};
    bass.frets.height_m.clear();
    bass.quality.mode_limit_hz = 3000;
    bass.pickups = {{.place = {}, .quantity = PickupQuantity::BridgeForce}};
    const InstrumentModel model = compile_instrument(bass, 48000).value();
    InstrumentState state = make_instrument_state(model);
    const double from_hz = 55 * std::exp2((from - 33) / 12.0);
    const double to_hz = 55 * std::exp2((to - 33) / 12.0);
    const auto x =
        play(model, state,
             {set_parameter(0, ParameterId::Legato, 1), set_parameter(0, ParameterId::SlideTime, 0.1),
              note_on(0, from, 0.3), note_on(14000, to, 0.3)},
             38000)
            .left;
    // A partial's bridge force is T k pi/L times its amplitude, which a slowly changing length keeps.
    const double expected = to_hz / from_hz;
    return {20 * std::log10(level_at(x, 24000, 12000, to_hz) / level_at(x, 1500, 12000, from_hz) / expected),
            state.work.transfers_J, string_energy(model, state, 0)};
}

/// The slower a string's length changes, the nearer its partials keep their amplitudes (the adiabatic law:
/// energy follows frequency), whichever way the hand goes.
TEST(Slide, KeepsThePartialsAmplitudes) {
    for (const auto& [from, to] : {std::pair{33, 40}, std::pair{40, 33}, std::pair{35, 36}}) {
        const SlideEnd end = slide_end(from, to);
        EXPECT_NEAR(end.level_db, 0, 0.3) << from << " to " << to;
        EXPECT_LT(std::abs(end.transfer_J), 0.02 * end.energy_J);
    }
}

/// A light touch at a third of the string leaves the partials that have a node there.
TEST(Harmonic, LeavesThePartialsWithANodeUnderTheFinger) {
    const auto plain = mono(free_model(), {note_on(0, 33, 0.3)}, 48000);
    for (const int n : {2, 3, 5}) {
        const auto touched =
            mono(free_model(), {set_parameter(0, ParameterId::Harmonic, n), note_on(0, 33, 0.3)}, 48000);
        const auto loss_db = [&](int k) {
            const double hz = 55 * k * std::sqrt((1 + 6e-5 * k * k) / (1 + 6e-5));
            return 20 * std::log10(level_at(touched, 12000, 36000, hz) / level_at(plain, 12000, 36000, hz));
        };
        EXPECT_GT(loss_db(n), -2) << n;
        for (int k = 1; k < n; ++k) EXPECT_LT(loss_db(k), -40) << "partial " << k << " of harmonic " << n;
    }
}

/// A hand that is weak enough for first order: the first partial's decay rate is the string's own and the
/// hand's, ln(1000)/T60 each.
TEST(Release, DecaysInTheTimeThePresetSays) {
    InstrumentDescription bass = test::bass_instrument();
    bass.strings = {bass.strings[1]};
    bass.frets = {};
    bass.quality.mode_limit_hz = 3000;
    bass.hand.release_t60_s = 1.2;
    const InstrumentModel model = compile_instrument(bass, 48000).value();
    const double own = model.strings[0].stopped[0].string.shape->sigma[0];
    for (const double velocity : {0.0, 0.5, 1.0}) {
        InstrumentState state = make_instrument_state(model);
        const auto x = play(model, state, {note_on(0, 33, 0.3), note_off(2000, 33, velocity)}, 48000).left;
        const double t60 = 1.2 * std::pow(2.0, 1 - 2 * velocity);
        const double fall = std::log(level_at(x, 6000, 9600, 55) / level_at(x, 20400, 9600, 55)) / 0.3;
        EXPECT_NEAR(fall - own, std::log(1000.0) / t60, 0.08 * std::log(1000.0) / t60) << velocity;
    }
}

/// A string that is lifted slowly by h at x and let go is d'Alembert's: partial k moves with the amplitude 2
/// h L^2 sin(k pi x/L)/(k^2 pi^2 x (L - x)). What the finger damps while it pulls has ended by then.
TEST(Finger, HoldsNothingOnceItLetsGo) {
    InstrumentDescription bass = test::bass_instrument();
    bass.strings = {bass.strings[1]};
    bass.strings[0].damping = NoLoss{};
    bass.frets = {};
    bass.quality.mode_limit_hz = 3000;
    const double L = bass.strings[0].length_m, d = 0.16, pickup = 0.3, h = 0.002;
    bass.exciters[0].body =
        FingerDescription{.rise_s = 0.1, .release_s = 1e-4, .full_height_m = h, .damping_kg_per_s = 5};
    bass.pickups = {{.place = {.from_bridge_m = pickup}, .quantity = PickupQuantity::Displacement}};
    const InstrumentModel model = compile_instrument(bass, 48000).value();
    InstrumentState state = make_instrument_state(model);
    const auto x = play(model, state, {note_on(0, 33, 1)}, 48000).left;
    for (int k = 1; k <= 8; ++k) {
        const double hz = 55 * k * std::sqrt((1 + 6e-5 * k * k) / (1 + 6e-5));
        const double shape = 2 * h * L * L * std::sin(k * pi * d / L) / (k * k * pi * pi * d * (L - d));
        const double amplitude = 0.3 * std::abs(shape * std::sin(k * pi * pickup / L));
        EXPECT_NEAR(20 * std::log10(level_at(x, 6000, 36000, hz) / amplitude), 0, 0.2) << k;
    }
}

/// 60 dB decay time of the first partial under the palm.
double palm_t60(double mute) {
    const auto x =
        mono(free_model(), {set_parameter(0, ParameterId::PalmMute, mute), note_on(0, 33, 0.5)}, 20000);
    return 3 * 0.15 / std::log10(level_at(x, 2400, 4800, 55) / level_at(x, 9600, 4800, 55));
}

TEST(Palm, DampsMoreTheFirmerItLiesAllTheWay) {
    double before = palm_t60(0.05);
    for (const double mute : {0.2, 0.4, 0.6, 0.8, 1.0}) {
        const double now = palm_t60(mute);
        EXPECT_LT(now, 0.87 * before) << mute;
        before = now;
    }
}

TEST(DeadNote, DiesAtOnce) {
    const auto plain = mono(free_model(), {note_on(0, 33, 0.5)}, 24000);
    const auto dead =
        mono(free_model(), {set_parameter(0, ParameterId::DeadNote, 1), note_on(0, 33, 0.5)}, 24000);
    EXPECT_LT(level_at(dead, 9600, 9600, 55), 0.03 * level_at(plain, 9600, 9600, 55));
    EXPECT_GT(sharpest(dead, 1, 1200), 0.1 * sharpest(plain, 1, 1200));
}

// ---------------------------------------------------------------------------------------------- notes

std::vector<int> held_keys(const InstrumentState& state) {
    std::vector<int> keys;
    for (const CourseState& course : state.courses) keys.push_back(course.held.active ? course.held.key : -1);
    return keys;
}

TEST(Courses, OneKeyPlaysAllStringsOneAfterTheOther) {
    InstrumentState state = make_instrument_state(small_model());
    play(small_model(), state, {note_on(0, 31, 0.5)}, 20);
    EXPECT_EQ(held_keys(state), (std::vector{31, -1}));
    EXPECT_EQ(state.counters.notes, 1U);
    EXPECT_TRUE(state.strings[1].pending.active);
    play(small_model(), state, {}, 40);  // the delay is 48 frames
    EXPECT_EQ(state.counters.notes, 2U);
    EXPECT_EQ(state.strings[1].voices[state.strings[1].sounding].fret, 3U);
    play(small_model(), state, {note_off(0, 31)}, 10);
    EXPECT_EQ(held_keys(state), (std::vector{-1, -1}));
    EXPECT_EQ(state.strings[0].sounding, no_voice);
    EXPECT_EQ(state.strings[1].sounding, no_voice);
}

TEST(Guitar, AChannelIsACourseAndOverlapsAreLegato) {
    InstrumentState state = make_instrument_state(small_model());
    state.play = PlayMode::Guitar;
    play(small_model(), state, {note_on(0, 45, 0.5, 1), note_on(0, 45, 0.5, 0), note_on(0, 45, 0.5, 9)}, 500);
    EXPECT_EQ(held_keys(state), (std::vector{-1, 45}));
    EXPECT_EQ(state.counters.ignored_notes, 2U);
    play(small_model(), state, {note_on(0, 47, 0.5, 1)}, 500);
    EXPECT_EQ(state.counters.legato_notes, 1U);
    InstrumentEvent off = note_off(0, 47);
    off.channel = 1;
    play(small_model(), state, {off}, 500);  // back to the key that is still down
    EXPECT_EQ(held_keys(state), (std::vector{-1, 45}));
    EXPECT_EQ(state.counters.legato_notes, 2U);
    off.key = 45;
    play(small_model(), state, {off}, 10);
    EXPECT_EQ(held_keys(state), (std::vector{-1, -1}));
}

TEST(Repeats, ActOnTheMotionThatSounds) {
    InstrumentState state = make_instrument_state(free_model());
    play(free_model(), state, {note_on(0, 35, 0.5), note_on(3000, 35, 0.5)}, 4000);
    EXPECT_EQ(state.strings[0].busy, 1U);
    EXPECT_EQ(state.counters.notes, 2U);
    play(free_model(), state, {note_off(0, 35), note_on(500, 35, 0.5)}, 1000);
    EXPECT_EQ(state.strings[0].busy, 1U);
}

TEST(Bends, NameNotesOrChannels) {
    InstrumentState state = make_instrument_state(small_model());
    InstrumentEvent of_note = bend_channel(0, 1);
    of_note.key = 31;
    InstrumentEvent of_channel = bend_channel(0, 0.5);
    play(small_model(), state, {note_on(0, 31, 0.5), note_on(0, 45, 0.5), of_note, of_channel}, 4800);
    EXPECT_EQ(state.strings[0].voices[state.strings[0].sounding].bend.semitones, 1);
    EXPECT_EQ(state.strings[2].voices[state.strings[2].sounding].bend.semitones, 0.5);
    play(small_model(), state, {reset_controllers(0)}, 4800);
    EXPECT_FALSE(state.strings[0].voices[state.strings[0].sounding].bend.active);
}

TEST(Stems, AddUpToWhatPansLeave) {
    InstrumentDescription bass = test::bass_instrument();
    bass.strings.resize(2);
    bass.frets.count = 2;
    bass.frets.height_m.resize(2);
    const InstrumentModel model = compile_instrument(bass, 48000).value();
    InstrumentState state = make_instrument_state(model);
    std::vector<double> left(500), right(500), low(500), high(500);
    const std::array<double*, 2> stems{low.data(), high.data()};
    const std::vector<InstrumentEvent> events{note_on(0, 28, 0.5), note_on(0, 33, 0.5)};
    render_instrument(model, state, events, InstrumentOutput{left.data(), right.data(), stems}, 500);
    for (std::size_t n = 0; n < 500; ++n) {
        ASSERT_NEAR(left[n], low[n] + high[n], 1e-12);
        ASSERT_NEAR(right[n], low[n] + high[n], 1e-12);
    }
    EXPECT_GT(sharpest(low, 1, 499), 0);
    EXPECT_GT(sharpest(high, 1, 499), 0);
}

TEST(Tuning, SetsPitchesAndMovesFretsWhenAsked) {
    InstrumentDescription bass = test::bass_instrument();
    bass.strings.resize(1);
    bass.frets.count = 5;
    bass.frets.height_m.resize(5);
    bass.note_frequency_hz.assign(128, std::nan(""));
    for (std::size_t n = 28; n <= 33; ++n) bass.note_frequency_hz[n] = 40 * std::exp2((double(n) - 28) / 10);
    bass.note_frequency_hz[30] = std::nan("");
    for (const bool moves : {false, true}) {
        bass.tuning_moves_frets = moves;
        const InstrumentModel model = compile_instrument(bass, 48000).value();
        const auto& stopped = model.strings[0].stopped;
        EXPECT_EQ(stopped[2].key, -1);
        EXPECT_NEAR(stopped[5].string.tuning.omega[0], 2 * pi * 40 * std::exp2(0.5), 1e-9);
        const double expected = moves ? 0.863 * std::exp2(-0.5) : 0.863 * std::exp2(-5.0 / 12);
        EXPECT_NEAR(stopped[5].string.shape->length_m, expected, 1e-12);
        InstrumentState state = make_instrument_state(model);
        play(model, state, {note_on(0, 30, 0.5), note_on(0, 31, 0.5)}, 10);
        EXPECT_EQ(state.counters.ignored_notes, 1U);
    }
}

// ---------------------------------------------------------------------------------------------- storms

TEST(Storm, BlockSizeDoesNotChangeABit) {
    auto events = test::storm(3, 12000, 300);
    events.push_back(set_parameter(11000, ParameterId::Legato, 1, 7));
    events.push_back(set_parameter(11000, ParameterId::SlideTime, 0, 7));
    std::size_t frame = 11000;
    for (const int key : {45, 47, 44}) events.push_back(note_on(frame += 200, key, 0.8, 7));
    std::stable_sort(events.begin(), events.end(),
                     [](const auto& a, const auto& b) { return a.frame < b.frame; });
    const auto performance = [&](std::size_t block) {
        InstrumentState state = make_instrument_state(small_model());
        const Played played = play(small_model(), state, events, 12000, block);
        EXPECT_GT(state.counters.legato_notes, 0U);
        EXPECT_GT(contact_counters(state).impulses, 0U);
        return played;
    };
    const Played whole = performance(12000);
    for (const std::size_t block : {1U, 37U, 512U}) EXPECT_TRUE(performance(block) == whole) << block;
}

InstrumentDescription noisy_instrument() {
    InstrumentDescription noisy = test::small_instrument();
    std::get<FingerDescription>(noisy.exciters[0].body).roughness = 0.3;
    noisy.hand.release_noise_N = 0.5;
    return noisy;
}

TEST(Noise, HasTheSameBitsInAnyBlockAndAfterAReset) {
    const InstrumentModel model = compile_instrument(noisy_instrument(), 48000).value();
    const auto events = test::storm(4, 12000, 200);
    InstrumentState state = make_instrument_state(model);
    const Played whole = play(model, state, events, 12000, 12000);
    EXPECT_NE(state.work.noises_J, 0);
    reset(model, state);
    EXPECT_TRUE(play(model, state, events, 12000, 37) == whole);
}

/// A finger on a string at rest makes a sound as it comes; without release_noise_N there is none.
TEST(Noise, IsHeardAtNoteOffAndFollowsTheReleaseVelocity) {
    const auto after_release = [](double noise_N, double velocity) {
        InstrumentDescription bass = test::bass_instrument();
        bass.strings = {bass.strings[1]};
        bass.frets = {};
        bass.hand.release_noise_N = noise_N;
        bass.hand.release_spread = 2;
        const InstrumentModel model = compile_instrument(bass, 48000).value();
        InstrumentState state = make_instrument_state(model);
        const auto x = play(model, state, {note_on(0, 33, 1e-4), note_off(2000, 33, velocity)}, 6000).left;
        double sum = 0;
        for (std::size_t n = 2000; n < 6000; ++n) sum += x[n] * x[n];
        return std::sqrt(sum);
    };
    const double usual = after_release(0.1, 0.5);
    EXPECT_GT(usual, 20 * after_release(0, 0.5));
    EXPECT_GT(after_release(0.1, 1), 1.5 * usual);
    EXPECT_LT(after_release(0.1, 0), 0.7 * usual);
}

TEST(Storm, EndsInSilenceWithoutAnythingLost) {
    for (unsigned seed = 10; seed < 16; ++seed) {
        InstrumentState state = make_instrument_state(small_model());
        if (seed % 2 == 1) state.play = PlayMode::Guitar;
        auto events = test::storm(seed, 6000, 200);
        for (int channel = 0; channel < 3; ++channel) {
            events.push_back(reset_controllers(6000, channel));
            events.push_back(all_notes_off(6000, channel));
        }
        const Played played = play(small_model(), state, events, 8000);
        for (const double x : played.left) ASSERT_TRUE(std::isfinite(x));
        EXPECT_EQ(contact_counters(state).nonfinite_resets, 0U);
        EXPECT_TRUE(std::isfinite(state.work.touches_J + state.work.exciters_J + state.work.bends_J));
        EXPECT_EQ(held_keys(state), (std::vector{-1, -1})) << "seed " << seed;  // nothing hangs
        for (int channel = 0; channel < 3; ++channel)
            play(small_model(), state, {all_sound_off(0, channel)}, 200);
        for (const InstrumentStringState& string : state.strings) EXPECT_EQ(string.busy, 0U);
    }
}

/// A string, a hammer and a bend poisoned with NaN: caught, counted, and the other strings do not notice.
TEST(Storm, NonsenseStaysOnItsString) {
    const std::vector<InstrumentEvent> start{note_on(0, 31, 0.5), note_on(0, 45, 0.5), bend_channel(0, 1)};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    InstrumentState expected = make_instrument_state(small_model());
    InstrumentState state = make_instrument_state(small_model());
    play(small_model(), expected, start, 600);
    play(small_model(), state, start, 600);
    Voice& poisoned = state.strings[2].voices[state.strings[2].sounding];
    poisoned.string.velocity[3] = nan;
    poisoned.touches.exciter.phase = ExciterPhase::Hammer;
    poisoned.touches.exciter.position_m = nan;
    std::vector<double> stems[3], clean[3];
    for (int s = 0; s < 3; ++s) stems[s].resize(2000), clean[s].resize(2000);
    std::vector<double> left(2000), right(2000);
    const std::array<double*, 3> a{stems[0].data(), stems[1].data(), stems[2].data()};
    const std::array<double*, 3> b{clean[0].data(), clean[1].data(), clean[2].data()};
    render_instrument(small_model(), state, {}, InstrumentOutput{left.data(), right.data(), a}, 2000);
    EXPECT_GE(contact_counters(state).nonfinite_resets, 1U);
    for (std::size_t n = 2; n < 2000; ++n) {
        ASSERT_TRUE(std::isfinite(left[n])) << n;
        ASSERT_TRUE(std::isfinite(stems[2][n])) << n;
    }
    render_instrument(small_model(), expected, {}, InstrumentOutput{left.data(), right.data(), b}, 2000);
    EXPECT_EQ(stems[0], clean[0]);
    EXPECT_EQ(stems[1], clean[1]);
}

}  // namespace
}  // namespace jawari
