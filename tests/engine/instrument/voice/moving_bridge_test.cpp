// The moving bridge: strings and body against the eigenmodes of the whole.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "instrument/voice/voice.h"
#include "jawari/instrument/compile.h"
#include "jawari/instrument/render.h"
#include "jawari/scene/energy.h"
#include "jawari/scene/render.h"
#include "support/moving_bridge.h"
#include "support/small_instrument.h"

namespace jawari {
namespace {

constexpr double rate_hz = 48000;

class Chance {
  public:
    explicit Chance(std::uint64_t seed) : random_(seed) {}
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
    }
    double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

  private:
    std::mt19937_64 random_;
};

/// Two to four open strings without obstacles on a body of three to eight modes.
InstrumentDescription random_instrument(std::uint64_t seed) {
    Chance chance(seed);
    InstrumentDescription instrument;
    instrument.quality = {.contact_rate_min_hz = 192000, .mode_limit_hz = 20000};
    instrument.exciters.push_back(
        {.name = "finger", .place = {.share = 0.2}, .body = FingerDescription{.full_height_m = 0.001}});
    const auto strings = static_cast<std::size_t>(chance.uniform(2, 5));
    for (std::size_t s = 0; s < strings; ++s) {
        InstrumentStringDescription string;
        string.open_note = 60;
        string.open_frequency_hz = chance.log_uniform(400, 1200);
        string.length_m = chance.uniform(0.4, 0.9);
        string.linear_density_kg_per_m = chance.log_uniform(3e-4, 8e-3);
        string.inharmonicity = chance.log_uniform(1e-6, 3e-4);
        string.damping = DecayTimePoints{{{{100, chance.uniform(2, 20)}, {8000, chance.uniform(0.3, 2)}}}};
        instrument.strings.push_back(string);
    }
    const auto modes = static_cast<std::size_t>(chance.uniform(3, 9));
    for (std::size_t j = 0; j < modes; ++j) {
        BodyModeDescription mode;
        mode.frequency_hz = chance.log_uniform(60, 8000);
        mode.t60_s = chance.log_uniform(0.02, 1);
        mode.gain_left = mode.gain_right = 1;
        mode.mass_kg = chance.log_uniform(0.05, 1);
        for (std::size_t s = 0; s < strings; ++s) mode.shape.push_back(chance.uniform(-1, 1));
        instrument.body.push_back(mode);
    }
    instrument.bridge = BridgeDescription{};
    return instrument;
}

/// All strings sound, at rest.
InstrumentState state_of(const InstrumentModel& model) {
    InstrumentState state = make_instrument_state(model);
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        InstrumentStringState& string = state.strings[s];
        start_voice(model, model.strings[s], string.voices[0], 0, 0, 0);
        string.busy = 1;
        string.sounding = 0;
    }
    state.busy = true;
    return state;
}

/// A view of all coordinates of strings and body.
std::vector<double*> coordinates_of(const InstrumentModel& model, InstrumentState& state) {
    std::vector<double*> all;
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        StringState& string = state.strings[s].voices[0].string;
        for (std::size_t k = 0; k < model.strings[s].stopped[0].string.shape->mode_count; ++k) {
            all.push_back(&string.displacement[k]);
            all.push_back(&string.velocity[k]);
        }
    }
    for (std::size_t j = 0; j < model.bridge.count; ++j) {
        all.push_back(&state.bridge.y[j]);
        all.push_back(&state.bridge.v[j]);
    }
    return all;
}

/// One output frame of the engine as a matrix over the coordinates.
Eigen::MatrixXd frame_matrix(const InstrumentModel& model) {
    const InstrumentState still = state_of(model);
    InstrumentState state = still;
    const std::size_t n = coordinates_of(model, state).size();
    Eigen::MatrixXd matrix(n, n);
    for (std::size_t column = 0; column < n; ++column) {
        state = still;
        // Large and unlike each other, so that no mode is too weak to be computed.
        *coordinates_of(model, state)[column] = 1;
        for (std::size_t s = 0; s < model.strings.size(); ++s)
            notice_change(model.strings[s].stopped[0].string, state.strings[s].voices[0].string);
        state.bridge.ringing = true;
        double out = 0;
        render_instrument(model, state, {}, &out, 1);
        const std::vector<double*> end = coordinates_of(model, state);
        for (std::size_t row = 0; row < n; ++row)
            matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = *end[row];
    }
    return matrix;
}

/// The differential equations of the whole, in displacements and true velocities:
///     q'' + 2 sigma q' + omega^2 q = (b/mu) z,   m (y'' + 2 sigma y' + omega^2 y) = sum psi (b.q - kappa z)
/// with z = psi.y, b_k = mu omega_k^2 a_k, a_k the k-th coefficient of x/L, kappa = sum b_k a_k + T/L.
/// Partials above those that are computed follow the bridge without delay: of them its end has the mass sum
/// mu a_k^2.
Eigen::MatrixXd continuous_matrix(const InstrumentDescription& instrument, const InstrumentModel& model) {
    std::size_t n = model.bridge.count;
    for (const auto& string : model.strings) n += string.stopped[0].string.shape->mode_count;
    const auto size = static_cast<Eigen::Index>(n);
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);  // per mass
    Eigen::VectorXd loss(size - static_cast<Eigen::Index>(model.bridge.count));
    const auto modes = static_cast<Eigen::Index>(model.bridge.count);
    const Eigen::Index first_of_body = size - modes;
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(modes, modes);
    for (Eigen::Index j = 0; j < modes; ++j)
        mass(j, j) = instrument.body[static_cast<std::size_t>(j)].mass_kg;
    Eigen::Index at = 0;
    for (std::size_t s = 0; s < instrument.strings.size(); ++s) {
        const InstrumentStringDescription& string = instrument.strings[s];
        const StringModel& compiled = model.strings[s].stopped[0].string;
        const double L = string.length_m, mu = string.linear_density_kg_per_m;
        // As the string is without the body, which draws it to its note.
        const double B = model.strings[s].stopped[0].inharmonicity;
        const double f0 = compiled.tuning.omega[0] / (2 * std::numbers::pi * std::sqrt(1 + B));
        double kappa = 4 * mu * L * f0 * f0;  // T/L
        std::vector<double> row;
        for (std::size_t k = 1; k <= compiled.shape->mode_count; ++k) {
            const auto n_k = static_cast<double>(k);
            const double omega = 2 * std::numbers::pi * f0 * n_k * std::sqrt(1 + B * n_k * n_k);
            const double a = std::sqrt(2 / L) * L / (n_k * std::numbers::pi) * (k % 2 == 0 ? -1 : 1);
            const double b = mu * omega * omega * a;
            kappa += b * a;
            row.push_back(b);
            stiffness(at, at) = omega * omega;
            loss(at) = compiled.shape->sigma[k - 1];
            for (std::size_t j = 0; j < instrument.body.size(); ++j) {
                const Eigen::Index to = first_of_body + static_cast<Eigen::Index>(j);
                stiffness(at, to) = -b / mu * instrument.body[j].shape[s];
                stiffness(to, at) = -b * instrument.body[j].shape[s];
            }
            ++at;
        }
        double above = std::numbers::pi * std::numbers::pi / 6;
        for (std::size_t k = row.size(); k > 0; --k) above -= 1 / static_cast<double>(k * k);
        Eigen::VectorXd shape(modes);
        for (Eigen::Index j = 0; j < modes; ++j)
            shape(j) = instrument.body[static_cast<std::size_t>(j)].shape[s];
        mass += mu * 2 * L / (std::numbers::pi * std::numbers::pi) * above * shape * shape.transpose();
        stiffness.bottomRightCorner(modes, modes) += kappa * shape * shape.transpose();
    }
    Eigen::MatrixXd body_loss = Eigen::MatrixXd::Zero(modes, modes);
    for (Eigen::Index j = 0; j < modes; ++j) {
        const BodyModeDescription& mode = instrument.body[static_cast<std::size_t>(j)];
        const double omega = 2 * std::numbers::pi * mode.frequency_hz;
        stiffness(first_of_body + j, first_of_body + j) += mode.mass_kg * omega * omega;
        body_loss(j, j) = mode.mass_kg * std::log(1000.0) / mode.t60_s;
    }
    const Eigen::MatrixXd per_mass = mass.inverse();
    stiffness.bottomRows(modes) = (per_mass * stiffness.bottomRows(modes)).eval();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2 * size, 2 * size);
    matrix.topRightCorner(size, size).setIdentity();
    matrix.bottomLeftCorner(size, size) = -stiffness;
    matrix.bottomRightCorner(size, size).diagonal().head(first_of_body) = -2 * loss;
    matrix.bottomRightCorner(modes, modes) = -2 * per_mass * body_loss;
    return matrix;
}

using Poles = std::vector<std::complex<double>>;

Poles poles_above(const Eigen::VectorXcd& values, double least_hz) {
    Poles poles;
    for (const std::complex<double>& value : values) {
        if (value.imag() > 2 * std::numbers::pi * least_hz) poles.push_back(value);
    }
    std::sort(poles.begin(), poles.end(), [](auto a, auto b) { return a.imag() < b.imag(); });
    return poles;
}

struct Worst {
    double cents = 0, decay = 0;
};

/// Every pole of the whole has a pole of the engine near it.
Worst compare(const Poles& expected, Poles found, double highest_hz) {
    Worst worst;
    for (const auto& pole : expected) {
        if (pole.imag() > 2 * std::numbers::pi * highest_hz) break;
        const auto nearest = std::min_element(found.begin(), found.end(), [&](auto a, auto b) {
            return std::abs(a - pole) < std::abs(b - pole);
        });
        worst.cents = std::max(worst.cents, std::abs(1200 * std::log2(nearest->imag() / pole.imag())));
        worst.decay = std::max(worst.decay, std::abs(nearest->real() / pole.real() - 1));
        found.erase(nearest);
    }
    return worst;
}

TEST(MovingBridge, HasTheEigenmodesOfTheWhole) {
    Worst worst;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const InstrumentDescription instrument = random_instrument(seed);
        const auto compiled = compile_instrument(instrument, rate_hz);
        ASSERT_TRUE(compiled.ok()) << compiled.failure().place << compiled.failure().value;
        const Eigen::VectorXcd frames = frame_matrix(compiled.value()).eigenvalues();
        const Eigen::VectorXcd found = frames.array().log() * rate_hz;
        const Eigen::VectorXcd expected = continuous_matrix(instrument, compiled.value()).eigenvalues();
        const Worst here = compare(poles_above(expected, 20), poles_above(found, 20), 9900);
        EXPECT_LT(here.cents, 0.05) << seed;
        EXPECT_LT(here.decay, 0.01) << seed;
        worst.cents = std::max(worst.cents, here.cents);
        worst.decay = std::max(worst.decay, here.decay);
    }
    RecordProperty("worst_cents", std::to_string(worst.cents));
    RecordProperty("worst_decay", std::to_string(worst.decay));
}

/// One string with the body sounds its note, by the eigenvalues of both. Resonances within a semitone are
/// moved away: they make two partials of one and keep both off the note, as a wolf does.
TEST(MovingBridge, TheFirstPartialWithTheBodyIsTheNote) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        InstrumentDescription instrument = random_instrument(seed);
        instrument.strings.resize(1);
        for (auto& mode : instrument.body) {
            mode.shape.resize(1);
            const double cents =
                1200 * std::log2(mode.frequency_hz / instrument.strings[0].open_frequency_hz);
            if (std::abs(cents) < 100) mode.frequency_hz *= 1.2;
        }
        const auto compiled = compile_instrument(instrument, rate_hz);
        ASSERT_TRUE(compiled.ok());
        const Eigen::VectorXcd values = continuous_matrix(instrument, compiled.value()).eigenvalues();
        double nearest_cents = 1e9;
        for (const auto& pole : values) {
            if (pole.imag() <= 0) continue;
            const double cents =
                1200 *
                std::log2(pole.imag() / (2 * std::numbers::pi * instrument.strings[0].open_frequency_hz));
            if (std::abs(cents) < std::abs(nearest_cents)) nearest_cents = cents;
        }
        EXPECT_LT(std::abs(nearest_cents), 0.1) << seed;
    }
}

/// Strings without losses on a body without losses (but for what a T60 of 20 s at 60 Hz takes).
TEST(MovingBridge, KeepsTheEnergyOfTheWhole) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        InstrumentDescription instrument = random_instrument(seed);
        for (auto& string : instrument.strings) string.damping = NoLoss{};
        for (auto& mode : instrument.body) mode.t60_s = 20;
        const auto compiled = compile_instrument(instrument, rate_hz);
        ASSERT_TRUE(compiled.ok());
        const InstrumentModel& model = compiled.value();
        InstrumentState state = state_of(model);
        std::mt19937_64 random(seed);
        std::normal_distribution<double> normal;
        for (double* coordinate : coordinates_of(model, state)) *coordinate = 1e-3 * normal(random);
        for (std::size_t s = 0; s < model.strings.size(); ++s)
            notice_change(model.strings[s].stopped[0].string, state.strings[s].voices[0].string);
        state.bridge.ringing = true;
        double out = 0;
        render_instrument(model, state, {}, &out, 1);  // the weight begins
        double before = test::whole_energy(model, state) - test::work_of(state.work);
        const double start = before;
        for (int n = 0; n < 2000; ++n) {
            render_instrument(model, state, {}, &out, 1);
            const double now = test::whole_energy(model, state) - test::work_of(state.work);
            ASSERT_LE(now, before + 1e-12 * start) << seed << " frame " << n;
            before = now;
        }
        EXPECT_GT(before, 0.9 * start) << seed;
    }
}

/// Two strings in unison on one bridge, the second sympathetic: it rings along, and stops when it is not
/// free.
InstrumentDescription with_second_string(bool sympathetic, double freedom) {
    InstrumentDescription instrument = random_instrument(3);
    instrument.strings.resize(2, instrument.strings[0]);
    instrument.strings[0] = instrument.strings[1];
    instrument.strings[0].open_frequency_hz = instrument.strings[1].open_frequency_hz = 440;
    instrument.strings[1].open_note = 61;
    instrument.strings[1].sympathetic = sympathetic;
    for (auto& mode : instrument.body) mode.shape = {1, 1};
    instrument.bridge = BridgeDescription{.open_strings = freedom};
    return instrument;
}

/// Energy of the second string over that of the first, half a second after a note on the first.
double answer_of(bool sympathetic, double freedom, bool pedal) {
    const auto compiled = compile_instrument(with_second_string(sympathetic, freedom), rate_hz);
    EXPECT_TRUE(compiled.ok());
    const InstrumentModel& model = compiled.value();
    InstrumentState state = make_instrument_state(model);
    std::vector<double> left(24000), right(24000);
    const std::vector<InstrumentEvent> events{set_sustain_pedal(0, pedal), note_on(0, 60, 1)};
    render_instrument(model, state, events, {left.data(), right.data(), {}}, left.size());
    return string_energy(model, state, 1) / string_energy(model, state, 0);
}

TEST(MovingBridge, OpenAndSympatheticStringsAnswer) {
    const double free = answer_of(false, 1, false);
    EXPECT_GT(free, 1e-4);
    EXPECT_LT(answer_of(false, 0.5, false), 0.1 * free);
    EXPECT_EQ(answer_of(false, 0, false), 0);
    EXPECT_EQ(answer_of(false, 0, true), free);  // dampers lift
    EXPECT_EQ(answer_of(true, 0, false), free);  // no damper
    EXPECT_EQ(compile_instrument(with_second_string(true, 0), rate_hz).value().strings[1].stopped[0].key, -1);
}

TEST(MovingBridge, BlocksDoNotChangeABitAndStringsAddUpToTheWhole) {
    const auto compiled = compile_instrument(test::played_instrument(0.2), rate_hz);
    ASSERT_TRUE(compiled.ok());
    const InstrumentModel& model = compiled.value();
    std::vector<InstrumentEvent> events;
    std::mt19937_64 random(11);
    for (std::size_t n = 0; n < 40; ++n) {
        for (InstrumentEvent event : test::random_event(random, model)) {
            event.frame = 301 * n;
            events.push_back(event);
        }
    }
    InstrumentState state = make_instrument_state(model);
    const test::Played whole = test::play(model, state, events, 14000, 14000);
    for (const std::size_t block : {1U, 17U, 64U, 512U}) {
        InstrumentState other = make_instrument_state(model);
        EXPECT_EQ(test::play(model, other, events, 14000, block), whole) << block;
    }
    InstrumentState third = make_instrument_state(model);
    std::vector<double> left(14000), right(14000);
    std::vector<std::vector<double>> strings(3, std::vector<double>(14000));
    std::vector<double*> pointers;
    for (auto& string : strings) pointers.push_back(string.data());
    for (InstrumentEvent& event : events) event.frame = std::min<std::size_t>(event.frame, 13999);
    render_instrument(model, third, events, {left.data(), right.data(), pointers}, left.size());
    EXPECT_EQ(left, whole.left);
    // Without pan, so of pickups that are in the middle; the body alone here.
    InstrumentDescription acoustic = test::played_instrument(0.2);
    acoustic.pickups.clear();
    const InstrumentModel body = compile_instrument(acoustic, rate_hz).value();
    InstrumentState fourth = make_instrument_state(body);
    render_instrument(body, fourth, events, {left.data(), right.data(), pointers}, left.size());
    double largest = 0;
    for (std::size_t n = 0; n < left.size(); ++n) largest = std::max(largest, std::abs(left[n]));
    ASSERT_GT(largest, 0);
    for (std::size_t n = 0; n < left.size(); ++n) {
        ASSERT_NEAR(strings[0][n] + strings[1][n] + strings[2][n], (left[n] + right[n]) / 2, 1e-9 * largest)
            << n;
    }
}

/// A copy of a state is a snapshot: it goes on by itself, under hands and exciters too.
TEST(MovingBridge, ACopyGoesOnWithoutTheOriginal) {
    InstrumentDescription instrument = random_instrument(5);
    std::get<FingerDescription>(instrument.exciters[0].body).damping_kg_per_s = 0.1;
    const auto compiled = compile_instrument(instrument, rate_hz);
    ASSERT_TRUE(compiled.ok());
    const InstrumentModel& model = compiled.value();
    const std::vector<InstrumentEvent> begin{note_on(0, 60, 0.7)};
    std::vector<double> begun(50), expected(4000), copied(4000);
    auto original = std::make_unique<InstrumentState>(make_instrument_state(model));
    render_instrument(model, *original, begin, begun.data(), begun.size());
    ASSERT_TRUE(original->strings[0].voices[0].touches.known.count > 1);
    InstrumentState copy = *original;
    render_instrument(model, *original, {}, expected.data(), expected.size());
    for (InstrumentStringState& string : original->strings) {
        for (Voice& voice : string.voices) {
            for (Touch& touch : voice.touches.touches) std::fill(touch.row.begin(), touch.row.end(), 1e9);
            std::fill(voice.touches.exciter.row.begin(), voice.touches.exciter.row.end(), 1e9);
        }
    }
    original.reset();
    render_instrument(model, copy, {}, copied.data(), copied.size());
    EXPECT_EQ(copied, expected);
}

/// A string that has lost its numbers keeps them to itself.
TEST(MovingBridge, LostNumbersStayWhereTheyAre) {
    const auto compiled = compile_instrument(random_instrument(5), rate_hz);
    const InstrumentModel& model = compiled.value();
    for (const double poison : {std::numeric_limits<double>::quiet_NaN(), 1e308}) {
        InstrumentState state = state_of(model);
        state.strings[0].voices[0].string.displacement[0] = 1e-3;
        notice_change(model.strings[0].stopped[0].string, state.strings[0].voices[0].string);
        std::vector<double> out(1000);
        render_instrument(model, state, {}, out.data(), out.size());
        state.strings[1].voices[0].string.displacement[2] = poison;
        notice_change(model.strings[1].stopped[0].string, state.strings[1].voices[0].string);
        render_instrument(model, state, {}, out.data(), out.size());
        for (const double sample : out) ASSERT_TRUE(std::isfinite(sample));
        EXPECT_GT(string_energy(model, state, 0), 0);
        EXPECT_TRUE(std::isfinite(test::whole_energy(model, state)));
        EXPECT_GE(contact_counters(state).nonfinite_resets + finished_nonfinite_resets(state), 1U);
    }
}

}  // namespace
}  // namespace jawari
