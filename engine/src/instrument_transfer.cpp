#include "instrument_transfer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "instrument_voice.h"
#include "jawari/energy.h"

namespace jawari {
namespace {

constexpr double pi = std::numbers::pi;

/// Mode j of a length L seen from the bridge at distance d: sqrt(2/L) (-1)^(j+1) sin(j pi d/L).
double sign_of(std::size_t j) {
    return j % 2 == 0 ? -1.0 : 1.0;
}

struct Lengths {
    double from_m = 0, to_m = 0;
    std::size_t from_modes = 0, to_modes = 0;
};

/// Integral over the new length of (u(d) - u(L') d/L') phi'_k with u = sum_j a_j sin(beta_j d):
///     -(N'/alpha_k) sum_j a_j sin(beta_j L') beta_j^2/(beta_j^2 - alpha_k^2),     N' = sqrt(2/L').
/// `a` holds a_j.
void project_onto_shorter(const Lengths& lengths, const double* a, double* out) {
    const double scale = std::sqrt(2 / lengths.to_m);
    for (std::size_t k = 1; k <= lengths.to_modes; ++k) {
        const double alpha = static_cast<double>(k) * pi / lengths.to_m;
        double sum = 0;
        for (std::size_t j = 1; j <= lengths.from_modes; ++j) {
            const double beta = static_cast<double>(j) * pi / lengths.from_m;
            const double apart = beta * beta - alpha * alpha;
            const double end = std::sin(beta * lengths.to_m);
            // Where both sines have the same length the product's integral is L'/2.
            sum += std::abs(apart) > 1e-9 * alpha * alpha ? -a[j - 1] * end * beta * beta / (alpha * apart)
                                                          : sign_of(k) * a[j - 1] * lengths.to_m / 2;
        }
        out[k - 1] += scale * sum;
    }
}

/// Integral over the old length of u phi'_k: N' (-1)^(k+1) sin(alpha_k L) sum_j a_j (-1)^j beta_j/(alpha_k^2
/// - beta_j^2).
void project_onto_longer(const Lengths& lengths, const double* a, double* out) {
    const double scale = std::sqrt(2 / lengths.to_m);
    for (std::size_t k = 1; k <= lengths.to_modes; ++k) {
        const double alpha = static_cast<double>(k) * pi / lengths.to_m;
        const double end = std::sin(alpha * lengths.from_m);
        double sum = 0;
        for (std::size_t j = 1; j <= lengths.from_modes; ++j) {
            const double beta = static_cast<double>(j) * pi / lengths.from_m;
            const double apart = alpha * alpha - beta * beta;
            sum += std::abs(apart) > 1e-9 * alpha * alpha ? -sign_of(j) * a[j - 1] * end * beta / apart
                                                          : a[j - 1] * lengths.from_m / 2;
        }
        out[k - 1] += scale * sign_of(k) * sum;
    }
}

void project(const Lengths& lengths, const double* a, double* out) {
    if (lengths.to_m > lengths.from_m) {
        project_onto_longer(lengths, a, out);
    } else {
        project_onto_shorter(lengths, a, out);
    }
}

}  // namespace

void carry_over(const InstrumentStringModel& string, const Voice& from, Voice& to,
                AlignedVector<double>& scratch, PlayerWork& work) JAWARI_REALTIME {
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
    AlignedVector<double>& projected = to.touches.moved;
    std::fill(projected.begin(), projected.end(), 0.0);
    for (std::size_t j = 0; j < lengths.from_modes; ++j) {
        const double q = from.string.displacement[j] - source.rest_displacement[j];
        scratch[j] = scale * sign_of(j + 1) * q;
    }
    project(lengths, scratch.data(), projected.data());
    for (std::size_t k = 0; k < lengths.to_modes; ++k) {
        to.string.displacement[k] += projected[k];
        to.string.velocity[k] = stop.backward_q[k] * projected[k];
    }
    std::fill(projected.begin(), projected.end(), 0.0);
    for (std::size_t j = 0; j < lengths.from_modes; ++j) {
        const double q = from.string.displacement[j] - source.rest_displacement[j];
        const double u = (from.string.velocity[j] - backward_q[j] * q) / backward_u[j];
        scratch[j] = scale * sign_of(j + 1) * u;
    }
    project(lengths, scratch.data(), projected.data());
    for (std::size_t k = 0; k < lengths.to_modes; ++k)
        to.string.velocity[k] += stop.backward_u[k] * projected[k];
    notice_change(stop.string, to.string);
    const double gained = energy(stop.string, to.string) - before - energy(source, from.string);
    if (std::isfinite(gained)) work.transfers_J += gained;
}

}  // namespace jawari
