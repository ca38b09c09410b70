// Geometry, pitch, losses and pickups of stopped strings: against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "instrument/model/stops.h"
#include "instrument/voice/voice.h"
#include "jawari/instrument/compile.h"
#include "jawari/instrument/model.h"
#include "jawari/instrument/state.h"
#include "jawari/scene/modes.h"
#include "support/bass_instrument.h"

namespace jawari {
namespace {

using test::bass_instrument;

constexpr double pi = std::numbers::pi;

const InstrumentModel& bass_model() {
    static const InstrumentModel model = compile_instrument(bass_instrument(), 48000).value();
    return model;
}

TEST(InstrumentCompile, FirstPartialIsTheNoteOnEveryStringAndFret) {
    for (const InstrumentStringModel& string : bass_model().strings) {
        ASSERT_EQ(string.stopped.size(), 21U);
        for (std::size_t fret = 0; fret < string.stopped.size(); ++fret) {
            const double note = string.stopped[0].key + static_cast<double>(fret);
            EXPECT_EQ(string.stopped[fret].key, note);
            const double equal_tempered_hz = 440 * std::pow(2.0, (note - 69) / 12);
            EXPECT_NEAR(string.stopped[fret].string.tuning.omega[0] / (2 * pi) / equal_tempered_hz, 1, 1e-13)
                << string.name << " fret " << fret;
        }
    }
}

TEST(InstrumentCompile, BendingStiffnessDoesNotDependOnTheFret) {
    const InstrumentDescription bass = bass_instrument();
    for (std::size_t s = 0; s < bass.strings.size(); ++s) {
        const auto stiffness = [&](std::size_t fret) {  // pi^2 E I = B T L^2
            const StringDescription stopped = stopped_string(bass, s, fret);
            const auto& modes = std::get<PhysicalModes>(stopped.modes);
            return modes.inharmonicity * modes.tension_N * stopped.length_m * stopped.length_m;
        };
        for (std::size_t fret = 1; fret <= 20; ++fret) EXPECT_NEAR(stiffness(fret) / stiffness(0), 1, 1e-13);
    }
}

TEST(InstrumentCompile, PartialsStretchAndStopAtTheLimit) {
    const InstrumentDescription bass = bass_instrument();
    const StringModel& e = bass_model().strings[0].stopped[0].string;
    const double B = bass.strings[0].inharmonicity;
    for (std::size_t k = 1; k <= e.shape->mode_count; ++k) {
        const double n = static_cast<double>(k);
        const double expected = n * std::sqrt((1 + B * n * n) / (1 + B));
        EXPECT_NEAR(e.tuning.omega[k - 1] / e.tuning.omega[0] / expected, 1, 1e-12);
    }
    EXPECT_LE(e.tuning.omega[e.shape->mode_count - 1] / (2 * pi), bass.quality.mode_limit_hz);
    const double next = static_cast<double>(e.shape->mode_count + 1);
    EXPECT_GT(e.tuning.omega[0] / (2 * pi) * next * std::sqrt((1 + B * next * next) / (1 + B)),
              bass.quality.mode_limit_hz);
}

/// In the neck's own coordinates: from the nut, heights from the open string's rest line.
TEST(InstrumentCompile, FretsBeyondTheStopKeepTheirPlaceInSpace) {
    const InstrumentDescription bass = bass_instrument();
    const double length = bass.strings[0].length_m;
    const auto fret_x = [&](std::size_t j) {
        return length * (1 - std::pow(0.5, static_cast<double>(j) / 12));
    };
    for (std::size_t fret = 0; fret <= 20; ++fret) {
        const StringDescription stopped = stopped_string(bass, 0, fret);
        ASSERT_EQ(stopped.contacts.size(), 20 - fret);
        const double stop_x = fret_x(fret);
        const double stop_h = fret == 0 ? 0 : bass.frets.height_m[fret - 1];
        for (std::size_t j = fret + 1; j <= 20; ++j) {
            const ContactDescription& contact = stopped.contacts[j - fret - 1];
            EXPECT_NEAR(stop_x + contact.position_m, fret_x(j), 1e-15);
            // The stopped string's rest line in space runs from the fret's top to the bridge.
            const double line = stop_h * (length - fret_x(j)) / (length - stop_x);
            EXPECT_NEAR(line + contact.height_m, bass.frets.height_m[j - 1], 1e-17);
            EXPECT_LT(contact.height_m, 0);
        }
    }
}

TEST(InstrumentCompile, FullVelocityLiftsTheStringAsHighAsSaid) {
    InstrumentDescription bass = bass_instrument();
    for (double& height : bass.frets.height_m) height *= 20;  // out of reach
    bass.strings.resize(1);
    const InstrumentModel model = compile_instrument(bass, 48000).value();
    const InstrumentStringModel& string = model.strings[0];
    for (const std::size_t fret : {0U, 7U, 20U}) {
        InstrumentState state = make_instrument_state(model);
        Voice& voice = state.strings[0].voices[0];
        start_voice(model, string, voice, fret, 0, 0);
        strike_voice(model, string, voice, {.fret = fret, .velocity = 1}, 1);
        double highest = 0;
        const double x = string.stopped[fret].string.shape->length_m - 0.16;
        while (voice.touches.exciter.phase != ExciterPhase::None) {
            VoiceSignals signals;
            advance_voice(model, string, voice, 1, state, {&signals, 1});
            double lift = 0;
            for (std::size_t k = 0; k < string.stopped[fret].string.shape->mode_count; ++k) {
                lift += mode_shape(k + 1, x, string.stopped[fret].string.shape->length_m) *
                        voice.string.displacement[k];
            }
            highest = std::max(highest, lift);
        }
        EXPECT_NEAR(highest, 0.004, 1e-6 * 0.004) << "fret " << fret;
    }
}

TEST(InstrumentCompile, NothingAboveTheOutputsNyquistRateIsHeard) {
    InstrumentDescription bass = bass_instrument();
    bass.quality.mode_limit_hz = 40000;
    const InstrumentModel model = compile_instrument(bass, 44100).value();
    for (const InstrumentStringModel& string : model.strings) {
        const StoppedStringModel& open = string.stopped[0];
        bool above = false;
        for (std::size_t k = 0; k < open.string.shape->mode_count; ++k) {
            if (open.string.tuning.omega[k] / (2 * pi) < 22050) continue;
            above = true;
            EXPECT_EQ(open.pickup_rows[k], 0);
        }
        EXPECT_TRUE(above);
        EXPECT_NE(open.pickup_rows[0], 0);
    }
}

TEST(InstrumentCompile, ContactRateIsRoundedUpToAMultipleOfTheOutputRate) {
    InstrumentDescription bass = bass_instrument();
    bass.strings.resize(1);
    bass.frets.height_m.resize(2);
    bass.frets.count = 2;
    for (const double rate : {44100.0, 48000.0, 96000.0}) {
        const InstrumentModel model = compile_instrument(bass, rate).value();
        EXPECT_GE(model.contact_rate_hz, bass.quality.contact_rate_min_hz);
        EXPECT_LT(model.contact_rate_hz, bass.quality.contact_rate_min_hz + rate);
        EXPECT_EQ(model.contact_rate_hz, rate * static_cast<double>(model.steps_per_frame));
    }
}

/// A diatonic fretboard, as dulcimers have, and one whose frets are where somebody measured them.
TEST(InstrumentCompile, FretsMayBeUnequalAndAnywhere) {
    InstrumentDescription bass = bass_instrument();
    bass.strings.resize(1);
    const InstrumentStringDescription& string = bass.strings[0];
    bass.frets.count = 3;
    bass.frets.semitones = {2, 4, 5};
    bass.frets.height_m = {-0.001, -0.0015, -0.002};
    const auto first_partial = [](const InstrumentDescription& described, std::size_t fret) {
        return compile_instrument(described, 48000).value().strings[0].stopped[fret].string.tuning.omega[0] /
               (2 * pi);
    };
    for (std::size_t fret = 1; fret <= 3; ++fret) {
        const double octaves = bass.frets.semitones[fret - 1] / 12.0;
        EXPECT_NEAR(stopped_string(bass, 0, fret).length_m, string.length_m * std::pow(0.5, octaves), 1e-12);
        EXPECT_NEAR(first_partial(bass, fret), string.open_frequency_hz * std::pow(2, octaves), 1e-9);
    }
    bass.frets.position_from_nut_m = {0.09, 0.18, 0.22};
    for (std::size_t fret = 1; fret <= 3; ++fret) {
        const StringDescription stopped = stopped_string(bass, 0, fret);
        EXPECT_NEAR(stopped.length_m, string.length_m - bass.frets.position_from_nut_m[fret - 1], 1e-12);
        ASSERT_EQ(stopped.contacts.size(), 3 - fret);
        for (std::size_t later = fret + 1; later <= 3; ++later)
            EXPECT_NEAR(stopped.contacts[later - fret - 1].position_m,
                        bass.frets.position_from_nut_m[later - 1] - bass.frets.position_from_nut_m[fret - 1],
                        1e-12);
    }
}

TEST(InstrumentCompile, ObstaclesKeepTheirPlaceFromBridgeNutOrStop) {
    InstrumentDescription bass = bass_instrument();
    bass.strings.resize(1);
    bass.frets.height_m.clear();
    const double length = bass.strings[0].length_m;
    for (const Origin origin : {Origin::Bridge, Origin::Nut, Origin::Stop}) {
        for (const std::size_t points : {0U, 6U}) {  // one at each corner, or spread
            bass.obstacles = {{.name = "wire",
                               .origin = origin,
                               .side = Side::Above,
                               .profile = CornerProfile{{0.3, 0.001}, {0.36, 0.0025}},
                               .points = points,
                               .strings = {}}};
            for (const std::size_t fret : {0U, 5U}) {
                const StringDescription stopped = stopped_string(bass, 0, fret);
                EXPECT_GE(stopped.contacts.size(), 2U);
                EXPECT_LE(stopped.contacts.size(), std::max<std::size_t>(points, 2));
                for (const ContactDescription& contact : stopped.contacts) {
                    double distance = contact.position_m;
                    if (origin == Origin::Bridge) distance = stopped.length_m - contact.position_m;
                    if (origin == Origin::Nut) distance += length - stopped.length_m;
                    EXPECT_GE(distance, 0.3 - 1e-12);
                    EXPECT_LE(distance, 0.36 + 1e-12);
                    EXPECT_NEAR(contact.height_m, 0.001 + 0.0015 * (distance - 0.3) / 0.06, 1e-12);
                    EXPECT_EQ(contact.side, Side::Above);
                }
            }
        }
    }
}

TEST(InstrumentCompile, RefusesWhatCannotBeBuilt) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto place_of = [](auto change, double rate = 48000) {
        InstrumentDescription bass = bass_instrument();
        change(bass);
        const auto model = compile_instrument(bass, rate);
        return model.ok() ? "accepted" : model.failure().place;
    };
    using D = InstrumentDescription;
    EXPECT_EQ(place_of([](D&) {}, 100), "output rate");
    EXPECT_EQ(place_of([&](D& d) { d.gain = nan; }), "gain");
    EXPECT_EQ(place_of([](D& d) { d.quality.contact_rate_min_hz = 1; }), "contact_rate_min_hz");
    EXPECT_EQ(place_of([](D& d) { d.quality.mode_limit_hz = 1e9; }), "mode_limit_hz");
    EXPECT_EQ(place_of([](D& d) { d.quality.mode_limit_hz = 4e6, d.quality.contact_rate_min_hz = 1e7; }),
              "mode_limit_hz");
    EXPECT_EQ(place_of([](D& d) { d.hand.release_t60_s = 0; }), "hand.release_t60_s");
    EXPECT_EQ(place_of([](D& d) { d.strings.clear(); }), "strings");
    EXPECT_EQ(place_of([](D& d) { d.strings[2].open_frequency_hz = -55; }), "strings[2].open_frequency_hz");
    EXPECT_EQ(place_of([](D& d) { d.strings[3].open_note = 120; }), "strings[3].open_note");
    EXPECT_EQ(place_of([](D& d) { d.strings[1].damping = ValetteLoss{}; }),
              "strings[1].modes.damping.diameter_m");
    EXPECT_EQ(place_of([](D& d) { d.frets.height_m[4] = 1e-3; }), "frets.height_m[4]");
    EXPECT_EQ(place_of([&](D& d) { d.frets.height_m[4] = nan; }), "frets.height_m[4]");
    EXPECT_EQ(place_of([](D& d) { d.frets.height_m[9] = -0.002; }),
              "frets.height_m[9]");  // above the line from fret 9
    EXPECT_EQ(place_of([](D& d) { d.frets.restitution = 2; }), "frets.restitution");
    EXPECT_EQ(place_of([](D& d) { d.exciters[0].place.from_bridge_m = 0.3; }),
              "exciters[0].position_from_bridge_m");
    EXPECT_EQ(place_of([](D& d) { std::get<FingerDescription>(d.exciters[0].body).full_height_m = 1; }),
              "exciters[0].full_height_m");
    EXPECT_EQ(place_of([](D& d) { d.pickups.clear(); }), "pickups");
    EXPECT_EQ(place_of([](D& d) { d.pickups[0].place.from_bridge_m = 0; }),
              "pickups[0].position_from_bridge_m");
    EXPECT_EQ(place_of([](D& d) { d.pickups[0].width_m = -1; }), "pickups[0].width_m");
    EXPECT_EQ(place_of([](D& d) { d.frets.semitones = {1, 2}; }), "frets.semitones");
    EXPECT_EQ(place_of([](D& d) { d.frets.position_from_nut_m = {0.1}; }), "frets.position_from_nut_m");
    const auto with_two_frets = [&](auto change) {
        return place_of([&](D& d) {
            d.frets.count = 2;
            d.frets.height_m.clear();
            change(d.frets);
        });
    };
    using F = FretsDescription;
    EXPECT_EQ(with_two_frets([](F& f) { f.semitones = {2, 2}; }), "frets.semitones[1]");
    EXPECT_EQ(with_two_frets([](F& f) {
                  f.position_from_nut_m = {0.2, 0.863};
              }),
              "frets.position_from_nut_m[1]");
    EXPECT_EQ(with_two_frets([](F& f) {
                  f.position_from_nut_m = {0.0, 0.2};
              }),
              "frets.position_from_nut_m[0]");
    EXPECT_EQ(place_of([](D& d) { d.exciters[0].first_string = 2, d.exciters[0].last_string = 1; }),
              "exciters[0].string_range[1]");
    EXPECT_EQ(place_of([](D& d) { d.pickups[0].place = {.share = 1}; }), "pickups[0].position_share");
    EXPECT_EQ(place_of([](D& d) { d.note_frequency_hz.assign(127, 440.0); }), "tuning");
    EXPECT_EQ(place_of([](D& d) {
                  d.note_frequency_hz.assign(128, 440.0);
                  d.note_frequency_hz[60] = 0;
              }),
              "tuning[60]");
}

}  // namespace
}  // namespace jawari
