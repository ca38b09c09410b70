#include "instrument/voice/legato_transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "instrument/voice/voice.h"
#include "jawari/scene/energy.h"

namespace jawari {
namespace {

using std::numbers::pi;

/// Mode j of a length L seen from the bridge at distance d: sqrt(2/L) (-1)^(j+1) sin(j pi d/L).
double sign_of(std::size_t j) {
    return j % 2 == 0 ? -1.0 : 1.0;
}

struct Lengths {
    double from_m = 0, to_m = 0;
    std::size_t from_modes = 0, to_modes = 0;
};

/// Shape and true velocity of a motion: sum_j a_j sin(beta_j d), beta_j = j pi/L.
struct Motion {
    std::array<double, transfer_modes> shape{}, speed{};
};

/// sum_j w_j/(beta_j^2 - alpha^2) of both.
struct Sums {
    double shape = 0, speed = 0;
};

/// All j but `left_out`, counted from 1. Four partial sums each, so that the divisions go side by side.
Sums sums_at(const Lengths& lengths, const Motion& weights, double alpha, std::size_t left_out) {
    constexpr std::size_t abreast = 4;
    static_assert(transfer_modes % abreast == 0);
    const double infinity = std::numeric_limits<double>::infinity();
    std::array<double, abreast> shape{}, speed{};
    for (std::size_t first = 0; first < lengths.from_modes; first += abreast) {  // weights beyond are zero
        for (std::size_t i = 0; i < abreast; ++i) {
            const std::size_t j = first + i + 1;
            const double beta = static_cast<double>(j) * pi / lengths.from_m;
            const double share = 1 / (j == left_out ? infinity : beta * beta - alpha * alpha);
            shape[i] += weights.shape[first + i] * share;
            speed[i] += weights.speed[first + i] * share;
        }
    }
    return {shape[0] + shape[1] + shape[2] + shape[3], speed[0] + speed[1] + speed[2] + speed[3]};
}

/// The old partial, of those that take part or higher, whose sine has the length of alpha's; 0: none.
std::size_t same_sine(const Lengths& lengths, double alpha) {
    const double j = std::round(alpha * lengths.from_m / pi);
    const double beta = j * pi / lengths.from_m;
    const bool is_same = std::abs(beta * beta - alpha * alpha) <= 1e-9 * alpha * alpha;
    return is_same ? static_cast<std::size_t>(j) : 0;
}

/// a_j <- the weights of the sums: onto a shorter length a_j beta_j^2 sin(beta_j L'), onto a longer one
/// (-1)^j a_j beta_j.
Motion weights_of(const Lengths& lengths, const Motion& motion) {
    Motion weights;
    for (std::size_t j = 1; j <= lengths.from_modes; ++j) {
        const double beta = static_cast<double>(j) * pi / lengths.from_m;
        const double weight =
            lengths.to_m > lengths.from_m ? sign_of(j) * beta : beta * beta * std::sin(beta * lengths.to_m);
        weights.shape[j - 1] = weight * motion.shape[j - 1];
        weights.speed[j - 1] = weight * motion.speed[j - 1];
    }
    return weights;
}

/// The projection onto phi'_k of the new length L', with N' = sqrt(2/L'). Onto a shorter length it is that of
/// u(d) - u(L') d/L':
///     -(N'/alpha_k) sum_j a_j sin(beta_j L') beta_j^2/(beta_j^2 - alpha_k^2),
/// onto a longer one N' (-1)^k sin(alpha_k L) sum_j (-1)^j a_j beta_j/(beta_j^2 - alpha_k^2). Where both
/// sines have the same length the product's integral is half the shorter length.
Motion project(const Lengths& lengths, const Motion& motion) {
    const Motion weights = weights_of(lengths, motion);
    const bool longer = lengths.to_m > lengths.from_m;
    const double scale = std::sqrt(2 / lengths.to_m);
    Motion projected;
    for (std::size_t k = 1; k <= lengths.to_modes; ++k) {
        const double alpha = static_cast<double>(k) * pi / lengths.to_m;
        const std::size_t same = same_sine(lengths, alpha);
        const Sums sums = sums_at(lengths, weights, alpha, same);
        const double factor = longer ? sign_of(k) * std::sin(alpha * lengths.from_m) : -1 / alpha;
        projected.shape[k - 1] = scale * factor * sums.shape;
        projected.speed[k - 1] = scale * factor * sums.speed;
        if (same == 0 || same > lengths.from_modes) continue;
        const double half = scale * sign_of(k) * std::min(lengths.from_m, lengths.to_m) / 2;
        projected.shape[k - 1] += half * motion.shape[same - 1];
        projected.speed[k - 1] += half * motion.speed[same - 1];
    }
    return projected;
}

/// Where a voice's modes are, and how fast they truly move.
struct Coordinates {
    const Voice& voice;
    const double* rest;
    const double* backward_q;
    const double* backward_u;

    [[nodiscard]] double displacement(std::size_t k) const { return voice.string.displacement[k] - rest[k]; }
    [[nodiscard]] double speed(std::size_t k) const {
        return (voice.string.velocity[k] - backward_q[k] * displacement(k)) / backward_u[k];
    }
};

Coordinates coordinates_of(const InstrumentStringModel& string, const Voice& voice) {
    const StoppedStringModel& stop = string.stopped[voice.fret];
    const bool bent = voice.bend.active;
    return {voice, stop.string.shape->rest_displacement.data(),
            bent ? voice.bend.backward_q.data() : stop.backward_q.data(),
            bent ? voice.bend.backward_u.data() : stop.backward_u.data()};
}

/// Adds a displacement and a true velocity to mode k of a voice that is not bent.
void add_motion(const StoppedStringModel& stop, Voice& voice, std::size_t k, double q, double u) {
    voice.string.displacement[k] += q;
    voice.string.velocity[k] = stop.backward_q[k] * q + stop.backward_u[k] * u;
}

/// After the transfer: `before_J` is the new voice's energy before it.
void meter_transfer(const InstrumentStringModel& string, const Voice& from, Voice& to, double before_J,
                    PlayerWork& work) {
    const StringModel& model = string.stopped[to.fret].string;
    notice_change(model, to.string);
    const double gained =
        energy(model, to.string) - before_J - energy(voice_model(string, from), from.string);
    if (std::isfinite(gained)) work.transfers_J += gained;
}

}  // namespace

void carry_over(const InstrumentStringModel& string, const Voice& from, Voice& to,
                PlayerWork& work) JAWARI_REALTIME {
    const StringShape& source = *voice_model(string, from).shape;
    const StoppedStringModel& stop = string.stopped[to.fret];
    const Coordinates old = coordinates_of(string, from);
    const Lengths lengths{source.length_m, stop.string.shape->length_m,
                          std::min(source.mode_count, transfer_modes),
                          std::min(stop.string.shape->mode_count, transfer_modes)};
    const double scale = std::sqrt(2 / source.length_m);
    const double before_J = energy(stop.string, to.string);
    // The backward velocity of the new voice is made of its shape and true velocity, each projected.
    Motion motion;
    for (std::size_t j = 0; j < lengths.from_modes; ++j) {
        motion.shape[j] = scale * sign_of(j + 1) * old.displacement(j);
        motion.speed[j] = scale * sign_of(j + 1) * old.speed(j);
    }
    const Motion projected = project(lengths, motion);
    for (std::size_t k = 0; k < lengths.to_modes; ++k)
        add_motion(stop, to, k, projected.shape[k], projected.speed[k]);
    meter_transfer(string, from, to, before_J, work);
}

/// The energy of a mode is mu (u^2 + omega^2 q^2)/2: with the same mu and omega it is that of the same q and
/// u.
void keep_partials(const InstrumentStringModel& string, const Voice& from, Voice& to,
                   PlayerWork& work) JAWARI_REALTIME {
    const StoppedStringModel& stop = string.stopped[to.fret];
    const Coordinates old = coordinates_of(string, from);
    const double before_J = energy(stop.string, to.string);
    const std::size_t modes =
        std::min(voice_model(string, from).shape->mode_count, stop.string.shape->mode_count);
    for (std::size_t k = 0; k < modes; ++k) add_motion(stop, to, k, old.displacement(k), old.speed(k));
    meter_transfer(string, from, to, before_J, work);
}

}  // namespace jawari
