#include "instrument/voice/pickups.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "instrument/model/stops.h"
#include "instrument/touch/touches.h"
#include "string/kernels/flight.h"
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

/// Partials up to this x = omega T/2 on a moving bridge are exact; a quarter of the output rate.
constexpr double highest_exact = pi / 4;
/// What partials above may be multiplied by at most, and at least.
constexpr double most_allowed = 3, least_allowed = 0.5;

/// A moving bridge meets the string once a frame: it gets the mean of the force at both ends of the frame,
/// which is cos(x) of the force in its middle, and holds it, which acts as sin(x)/x of it; so does the string
/// with the bridge's displacement. The row gives each partial back what that takes. Of what a partial above
/// the bridge's motion adds to the bridge's inertia, mu a_k^2, that leaves (x/sin x)^4, and x^2 cot^2 x of a
/// partial whose row stays as it is. The partials above highest_exact get one factor with which the inertia
/// of all is that of the string's end, mu L/3, as if no partial were left out.
void allow_for_frames(const StringModel& model, double output_rate_hz, double* row) {
    const auto square = [](double value) { return value * value; };
    double low = 0, high = 0;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        const double omega = model.tuning.omega[k];
        const double x = omega / (2 * output_rate_hz);
        if (row[k] == 0 || x >= pi / 2) continue;
        const double inertia_kg = square(row[k] / square(omega)) / model.shape->linear_density_kg_per_m;
        if (x > highest_exact) {
            high += inertia_kg * square(x / std::tan(x));
        } else {
            low += inertia_kg * square(square(x / std::sin(x)));
            row[k] *= x / (std::cos(x) * std::sin(x));
        }
    }
    const double end_kg = model.shape->linear_density_kg_per_m * model.shape->length_m / 3;
    const double allowed = std::sqrt(std::max(0.0, end_kg - low) / high);
    if (!(high > 0)) return;
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        if (model.tuning.omega[k] / (2 * output_rate_hz) > highest_exact)
            row[k] *= std::clamp(allowed, least_allowed, most_allowed);
    }
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

/// The field grows as the string comes closer.
bool has_magnet(const PickupDescription& pickup) {
    return pickup.magnet_distance_m > 0 && pickup.quantity == PickupQuantity::Velocity;
}

bool reads_velocity(const PickupDescription& pickup) {
    return pickup.quantity == PickupQuantity::Velocity;
}

bool reads_displacement(const PickupDescription& pickup) {
    return pickup.quantity != PickupQuantity::Velocity || has_magnet(pickup);
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
    if (instrument.bridge) {
        stopped.end_row = stopped.bridge_row;
        allow_for_frames(model, output_rate_hz, stopped.end_row.data());
        stopped.end_rest_N =
            product(stopped.end_row.data(), model.shape->rest_displacement, model.shape->stride);
    }
    stopped.bridge_rest_N =
        product(stopped.bridge_row.data(), model.shape->rest_displacement, model.shape->stride);
}

std::size_t output_rows(const InstrumentModel& model) JAWARI_REALTIME {
    std::size_t rows = model.body.count > 0 ? 1 : 0;
    for (const PickupDescription& pickup : model.pickups)
        rows += (reads_velocity(pickup) ? 1U : 0U) + (reads_displacement(pickup) ? 1U : 0U);
    return rows;
}

void set_output_readings(const InstrumentModel& model, const StoppedStringModel& stopped,
                         OutputReadings& readings) JAWARI_REALTIME {
    readings.count = 0;
    const auto add = [&](const double* row, bool of_velocity) {
        readings.rows[readings.count] = {row, of_velocity, readings.values[readings.count].data()};
        readings.count += 1;
    };
    for (std::size_t i = 0; i < model.pickups.size(); ++i) {
        const double* row = stopped.pickup_rows.data() + i * stopped.string.shape->stride;
        if (reads_velocity(model.pickups[i])) add(row, true);
        if (reads_displacement(model.pickups[i])) add(row, false);
    }
    if (model.body.count > 0) add(stopped.bridge_row.data(), false);
}

void read_outputs(const StringState& string, std::size_t n, const OutputReadings& readings) JAWARI_REALTIME {
    kernels::read(string.active_modes, readings.span(), string.displacement.data(), string.velocity.data(),
                  n);
}

double pickup_signal(const InstrumentModel& model, const StoppedStringModel& stopped,
                     const OutputReadings& readings, std::size_t n, double mix) JAWARI_REALTIME {
    double sum = 0;
    std::size_t row = 0;
    for (std::size_t i = 0; i < model.pickups.size(); ++i) {
        const PickupDescription& pickup = model.pickups[i];
        const double velocity = reads_velocity(pickup) ? readings.values[row++][n] : 0.0;
        const double displacement =
            reads_displacement(pickup) ? readings.values[row++][n] - stopped.pickup_rest[i] : 0.0;
        const double share = share_in_mix(i, model.pickups.size(), mix);
        if (share == 0) continue;
        double signal = pickup.quantity == PickupQuantity::Velocity ? velocity : displacement;
        if (has_magnet(pickup)) {
            const double gap = std::max(closest_share, 1 - displacement / pickup.magnet_distance_m);
            signal /= gap * gap * gap;
        }
        sum += share * pickup.level * signal;
    }
    return sum;
}

double bridge_force(const StoppedStringModel& stopped, const OutputReadings& readings,
                    std::size_t n) JAWARI_REALTIME {
    return readings.values[readings.count - 1][n] - stopped.bridge_rest_N;
}

}  // namespace jawari
