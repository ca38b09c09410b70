// Legato: the projection against numerical integrals.
#include "instrument/voice/legato_transfer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "instrument/voice/bend.h"
#include "instrument/voice/voice.h"
#include "jawari/instrument/compile.h"
#include "jawari/scene/energy.h"
#include "jawari/scene/modes.h"
#include "support/bass_instrument.h"

namespace jawari {
namespace {

InstrumentModel bass(std::size_t frets, bool flexible = false) {
    InstrumentDescription bass = test::bass_instrument();
    bass.strings.resize(1);
    if (flexible) bass.strings[0].inharmonicity = 0;
    bass.frets.height_m.clear();
    bass.frets.count = frets;
    return compile_instrument(bass, 48000).value();
}

/// u at distance d from the bridge.
double shape_at(const StringModel& model, const AlignedVector<double>& q, double d) {
    double u = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k)
        u += mode_shape(k + 1, model.shape->length_m - d, model.shape->length_m) * q[k];
    return u;
}

double true_velocity(const StoppedStringModel& stopped, const StringState& string, std::size_t k) {
    return (string.velocity[k] - stopped.backward_q[k] * string.displacement[k]) / stopped.backward_u[k];
}

void expect_projection(std::size_t from_fret, std::size_t to_fret) {
    const InstrumentModel model = bass(12);
    const InstrumentStringModel& string = model.strings[0];
    const StoppedStringModel& a = string.stopped[from_fret];
    const StoppedStringModel& b = string.stopped[to_fret];
    Voice from = make_voice(string.sizes), to = make_voice(string.sizes);
    start_voice(model, string, from, from_fret, 0, 0);
    start_voice(model, string, to, to_fret, 0, 0);
    AlignedVector<double> u(a.string.shape->stride, 0.0);
    for (std::size_t k = 0; k < 30; ++k) {
        from.string.displacement[k] =
            1e-3 * std::cos(static_cast<double>(k * k)) / std::pow(static_cast<double>(k + 1), 2);
        u[k] = std::sin(static_cast<double>(5 * k)) / static_cast<double>(k + 1);
        from.string.velocity[k] = a.backward_q[k] * from.string.displacement[k] + a.backward_u[k] * u[k];
    }
    const double before_J = energy(a.string, from.string) + energy(b.string, to.string);
    PlayerWork work;
    carry_over(string, from, to, work);
    ASSERT_GT(before_J, 0);
    EXPECT_NEAR(work.transfers_J, energy(b.string, to.string) - before_J, 1e-9 * before_J);
    const double shorter = std::min(a.string.shape->length_m, b.string.shape->length_m);
    const double end_q = shape_at(a.string, from.string.displacement, shorter);
    const double end_u = shape_at(a.string, u, shorter);
    const bool cut = b.string.shape->length_m < a.string.shape->length_m;
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}, std::size_t{5}, std::size_t{20}}) {
        double q_integral = 0, u_integral = 0;
        const int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            const double d = shorter * (i + 0.5) / steps;
            const double ramp = cut ? d / shorter : 0;
            const double phi =
                mode_shape(k, b.string.shape->length_m - d, b.string.shape->length_m) * shorter / steps;
            q_integral += phi * (shape_at(a.string, from.string.displacement, d) - ramp * end_q);
            u_integral += phi * (shape_at(a.string, u, d) - ramp * end_u);
        }
        EXPECT_NEAR(to.string.displacement[k - 1], q_integral, 1e-9) << k;
        EXPECT_NEAR(true_velocity(b, to.string, k - 1), u_integral, 1e-5) << k;
    }
}

TEST(Transfer, HammerOnProjectsWhatLiesOnTheShorterString) {
    expect_projection(0, 5);
    expect_projection(2, 3);
}
TEST(Transfer, PullOffFindsTheRestOfTheStringStill) {
    expect_projection(7, 2);
}
/// At an octave every second mode of the old length is one of the new: the formula's singular case.
TEST(Transfer, AnOctaveIsNoSpecialCase) {
    expect_projection(0, 12);
    expect_projection(12, 0);
}

/// At the end of a slide the old voice is bent to the new pitch: every partial keeps its energy.
TEST(Transfer, ASlidesEndKeepsTheEnergyOfEveryPartial) {
    const InstrumentModel model = bass(12, true);  // stiffness makes a shorter string sharper than a bent one
    const InstrumentStringModel& string = model.strings[0];
    for (const auto& [from_fret, to_fret] : {std::pair<std::size_t, std::size_t>{0, 7}, {9, 2}}) {
        const StoppedStringModel& a = string.stopped[from_fret];
        const StoppedStringModel& b = string.stopped[to_fret];
        Voice from = make_voice(string.sizes), to = make_voice(string.sizes);
        start_voice(model, string, from, from_fret, 0, 0);
        start_voice(model, string, to, to_fret, 0, 0);
        for (std::size_t k = 0; k < 20; ++k) {
            from.string.displacement[k] =
                1e-3 * std::cos(static_cast<double>(k * k)) / static_cast<double>(k + 1);
            from.string.velocity[k] = std::sin(static_cast<double>(5 * k)) / static_cast<double>(k + 1);
        }
        notice_change(a.string, from.string);
        PlayerWork work;
        set_bend(a, from, 12 * std::log2(b.frequency_hz / a.frequency_hz), work);
        const double before_J = voice_energy(string, from);
        keep_partials(string, from, to, work);
        const double after_J = voice_energy(string, to);
        EXPECT_NEAR(after_J, before_J, 0.002 * before_J);  // H of a bend is that of the compiled mobility
        EXPECT_NEAR(work.transfers_J, after_J - before_J, 1e-12 * before_J);
        for (std::size_t k = 0; k < 20; ++k)
            EXPECT_EQ(to.string.displacement[k], from.string.displacement[k]) << k;
    }
}

}  // namespace
}  // namespace jawari
