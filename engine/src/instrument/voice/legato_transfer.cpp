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

}  // namespace

void carry_over(const InstrumentStringModel& string, const Voice& from, Voice& to,
                PlayerWork& work) JAWARI_REALTIME {
    const StringModel& source = voice_model(string, from);
    const StoppedStringModel& stop = string.stopped[to.fret];
    const double* backward_q =
        from.bend.active ? from.bend.backward_q.data() : string.stopped[from.fret].backward_q.data();
    const double* backward_u =
        from.bend.active ? from.bend.backward_u.data() : string.stopped[from.fret].backward_u.data();
    const Lengths lengths{source.length_m, stop.string.length_m, std::min(source.mode_count, transfer_modes),
                          std::min(stop.string.mode_count, transfer_modes)};
    const double scale = std::sqrt(2 / source.length_m);
    const double before = energy(stop.string, to.string);
    // The backward velocity of the new motion is made of its shape and true velocity, each projected.
    Motion motion;
    for (std::size_t j = 0; j < lengths.from_modes; ++j) {
        const double q = from.string.displacement[j] - source.rest_displacement[j];
        const double u = (from.string.velocity[j] - backward_q[j] * q) / backward_u[j];
        motion.shape[j] = scale * sign_of(j + 1) * q;
        motion.speed[j] = scale * sign_of(j + 1) * u;
    }
    const Motion projected = project(lengths, motion);
    for (std::size_t k = 0; k < lengths.to_modes; ++k) {
        to.string.displacement[k] += projected.shape[k];
        to.string.velocity[k] =
            stop.backward_q[k] * projected.shape[k] + stop.backward_u[k] * projected.speed[k];
    }
    notice_change(stop.string, to.string);
    const double gained = energy(stop.string, to.string) - before - energy(source, from.string);
    if (std::isfinite(gained)) work.transfers_J += gained;
}

}  // namespace jawari
