#include "instrument/voice/pickups.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "instrument/model/stops.h"
#include "instrument/touch/touches.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

using std::numbers::pi;

/// Partials between this share of the output's Nyquist rate and all of it leave the output by half a cosine:
/// what an impulse sends to a pickup arrives as a band-limited pulse, without a step that would alias.
constexpr double taper_start = 0.85;

/// A string does not come closer to a pole than this share of their distance.
constexpr double closest_share = 0.2;

double audible_share(double frequency_hz, double output_rate_hz) {
    const double edge = frequency_hz / (output_rate_hz / 2);
    if (edge >= 1) return 0;
    return edge <= taper_start ? 1.0 : 0.5 * (1 - std::cos(pi * (1 - edge) / (1 - taper_start)));
}

/// T u' - E I u''' at the bridge, x = L: of mode k, with alpha = k pi/L, it is -(T alpha + E I alpha^3)
/// phi-amplitude cos(k pi) = -mu omega^2/alpha sqrt(2/L) cos(k pi). The string pulls the bridge by its
/// negative slope.
void write_bridge_row(const StringModel& model, double* row) {
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        const auto n = static_cast<double>(k + 1);
        const double alpha = n * pi / model.shape->length_m;
        const double sign = (k + 1) % 2 == 0 ? -1.0 : 1.0;
        row[k] = sign * std::sqrt(2 / model.shape->length_m) * model.shape->linear_density_kg_per_m *
                 model.tuning.omega[k] * model.tuning.omega[k] / alpha;
    }
}

void make_audible(const StringModel& model, double output_rate_hz, double* row) {
    for (std::size_t k = 0; k < model.shape->mode_count; ++k)
        row[k] *= audible_share(model.tuning.omega[k] / (2 * pi), output_rate_hz);
}

/// Gain of a low pass of second order whose gain at its resonance is Q.
double coil_gain(const PickupDescription& pickup, double frequency_hz) {
    const double r = frequency_hz / pickup.resonance_hz;
    return 1 / std::hypot(1 - r * r, r / pickup.quality_factor);
}

void pass_coil(const StringModel& model, const PickupDescription& pickup, double* row) {
    if (pickup.resonance_hz == 0) return;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k)
        row[k] *= coil_gain(pickup, model.tuning.omega[k] / (2 * pi));
}

double product(const double* row, const AlignedVector<double>& x, std::size_t modes) {
    return kernels::row_product(modes, row, x.data());
}

/// 1 but towards the other end of the mix.
double share_in_mix(std::size_t pickup, std::size_t count, double mix) {
    if (count < 2) return 1;
    const bool first_half = 2 * pickup + 1 < count || (2 * pickup + 1 == count && pickup == 0);
    return std::min(1.0, 2 * (first_half ? 1 - mix : mix));
}

}  // namespace

void set_output_rows(StoppedStringModel& stopped, const InstrumentDescription& instrument,
                     double output_rate_hz) {
    const StringModel& model = stopped.string;
    stopped.pickup_rows.assign(instrument.pickups.size() * model.shape->stride, 0.0);
    for (std::size_t i = 0; i < instrument.pickups.size(); ++i) {
        const PickupDescription& pickup = instrument.pickups[i];
        double* row = stopped.pickup_rows.data() + i * model.shape->stride;
        if (pickup.quantity == PickupQuantity::BridgeForce) {
            write_bridge_row(model, row);
        } else {
            const double x = model.shape->length_m - from_bridge(pickup.place, model.shape->length_m);
            write_point_row(model, model.shape->stride, x, pickup.width_m, row);
        }
        make_audible(model, output_rate_hz, row);
        pass_coil(model, pickup, row);
        stopped.pickup_rest.push_back(product(row, model.shape->rest_displacement, model.shape->stride));
    }
    if (instrument.body.empty()) return;
    stopped.bridge_row.assign(model.shape->stride, 0.0);
    write_bridge_row(model, stopped.bridge_row.data());
    make_audible(model, output_rate_hz, stopped.bridge_row.data());
    stopped.bridge_rest_N =
        product(stopped.bridge_row.data(), model.shape->rest_displacement, model.shape->stride);
}

double pickup_signal(const InstrumentModel& model, const StoppedStringModel& stopped,
                     const StringState& string, double mix) JAWARI_REALTIME {
    double sum = 0;
    const std::size_t modes = string.active_modes;
    for (std::size_t i = 0; i < model.pickups.size(); ++i) {
        const PickupDescription& pickup = model.pickups[i];
        const double share = share_in_mix(i, model.pickups.size(), mix);
        if (share == 0) continue;
        const double* row = stopped.pickup_rows.data() + i * stopped.string.shape->stride;
        const auto displacement = [&] {
            return product(row, string.displacement, modes) - stopped.pickup_rest[i];
        };
        double signal = pickup.quantity == PickupQuantity::Velocity ? product(row, string.velocity, modes)
                                                                    : displacement();
        if (pickup.magnet_distance_m > 0 && pickup.quantity == PickupQuantity::Velocity) {
            const double gap = std::max(closest_share, 1 - displacement() / pickup.magnet_distance_m);
            signal /= gap * gap * gap;
        }
        sum += share * pickup.level * signal;
    }
    return sum;
}

double bridge_force(const StoppedStringModel& stopped, const StringState& string) JAWARI_REALTIME {
    return product(stopped.bridge_row.data(), string.displacement, string.active_modes) -
           stopped.bridge_rest_N;
}

}  // namespace jawari
