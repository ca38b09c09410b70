#include "jawari/scene/systems.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/assert.h"
#include "base/square.h"
#include "jawari/scene/modes.h"

namespace jawari {
namespace {

/// sigma(f) = s_0 + s_1 f^2
struct Loss {
    double s0 = 0;
    double s1 = 0;
};

Loss loss_of(const SystemLoss& damping) {
    const auto* decay = std::get_if<DecayTimePoints>(&damping);
    if (decay == nullptr) return {};
    const auto [a, b] = decay->points;
    const double sigma_a = std::log(1000.0) / a.t60_s;
    const double sigma_b = std::log(1000.0) / b.t60_s;
    if (a.frequency_hz == b.frequency_hz) return {sigma_a, 0};
    const double s1 = (sigma_b - sigma_a) / (square(b.frequency_hz) - square(a.frequency_hz));
    return {sigma_a - s1 * square(a.frequency_hz), s1};
}

void append(ModeTable& table, double frequency_hz, const Loss& loss) {
    table.frequency_hz.push_back(frequency_hz);
    table.decay_per_s.push_back(std::max(0.0, loss.s0 + loss.s1 * square(frequency_hz)));
}

/// What the ends make of a bar, the stricter one at x = 0.
enum class Kind { ClampedClamped, ClampedPinned, ClampedFree, PinnedPinned, FreePinned, FreeFree };

struct Held {
    Kind kind = Kind::FreeFree;
    bool mirrored = false;  ///< x = 0 of the kind is at the bar's x = L
};

Held held(std::array<BarEnd, 2> ends) {
    const auto are = [&](BarEnd a, BarEnd b) { return ends[0] == a && ends[1] == b; };
    if (are(BarEnd::Clamped, BarEnd::Clamped)) return {Kind::ClampedClamped, false};
    if (are(BarEnd::Pinned, BarEnd::Pinned)) return {Kind::PinnedPinned, false};
    if (are(BarEnd::Clamped, BarEnd::Pinned)) return {Kind::ClampedPinned, false};
    if (are(BarEnd::Pinned, BarEnd::Clamped)) return {Kind::ClampedPinned, true};
    if (are(BarEnd::Clamped, BarEnd::Free)) return {Kind::ClampedFree, false};
    if (are(BarEnd::Free, BarEnd::Clamped)) return {Kind::ClampedFree, true};
    if (are(BarEnd::Free, BarEnd::Pinned)) return {Kind::FreePinned, false};
    if (are(BarEnd::Pinned, BarEnd::Free)) return {Kind::FreePinned, true};
    return {Kind::FreeFree, false};
}

/// The root near x of cos x = sign/cosh x.
double root_of_cosines(double x, double sign) {
    for (int i = 0; i < 60; ++i) {
        const double miss = std::cos(x) - sign / std::cosh(x);
        const double slope = -std::sin(x) + sign * std::tanh(x) / std::cosh(x);
        const double change = miss / slope;
        x -= change;
        if (std::abs(change) < 1e-16 * x) break;
    }
    return x;
}

/// The root near x of tan x = tanh x, as sin x = tanh x cos x.
double root_of_tangents(double x) {
    for (int i = 0; i < 60; ++i) {
        const double tanh = std::tanh(x);
        const double miss = std::sin(x) - tanh * std::cos(x);
        const double slope = std::cos(x) + tanh * std::sin(x) - (1 - square(tanh)) * std::cos(x);
        const double change = miss / slope;
        x -= change;
        if (std::abs(change) < 1e-16 * x) break;
    }
    return x;
}

double root_of(Kind kind, std::size_t k) {
    const auto n = static_cast<double>(k);
    switch (kind) {
        case Kind::PinnedPinned:
            return n * std::numbers::pi;
        case Kind::ClampedFree:
            return root_of_cosines((n - 0.5) * std::numbers::pi, -1);
        case Kind::ClampedPinned:
        case Kind::FreePinned:
            return root_of_tangents((n + 0.25) * std::numbers::pi);
        case Kind::ClampedClamped:
        case Kind::FreeFree:
            break;
    }
    return root_of_cosines((n + 0.5) * std::numbers::pi, 1);
}

/// cosh z - ratio sinh z without the cancellation of large numbers: `growth` is (1 - ratio)/2 e^x, x = beta
/// L.
double hyperbolic_part(double z, double x, double ratio, double growth) {
    return std::exp(-z) * (1 + ratio) / 2 + std::exp(z - x) * growth;
}

/// The shape at z = beta x from the kind's first end, mean square 1 (R. D. Blevins, Formulas for Natural
/// Frequency and Mode Shape, 1979, table 8-1).
double bending_shape(Kind kind, double z, double x) {
    if (kind == Kind::PinnedPinned) return std::numbers::sqrt2 * std::sin(z);
    const double decay = std::exp(-x);
    const double sine = std::sin(x);
    const double cosine = std::cos(x);
    double difference = 0;  // (1 - ratio)/2 e^x
    double ratio = 0;
    if (kind == Kind::ClampedFree) {
        // ratio = (sinh x - sin x)/(cosh x + cos x)
        const double denominator = 1 + square(decay) + 2 * decay * cosine;
        ratio = (1 - square(decay) - 2 * decay * sine) / denominator;
        difference = (decay + cosine + sine) / denominator;
    } else {
        // ratio = (cosh x - cos x)/(sinh x - sin x)
        const double denominator = 1 - square(decay) - 2 * decay * sine;
        ratio = (1 + square(decay) - 2 * decay * cosine) / denominator;
        difference = (cosine - sine - decay) / denominator;
    }
    const bool free = kind == Kind::FreeFree || kind == Kind::FreePinned;
    const double sign = free ? 1 : -1;
    return hyperbolic_part(z, x, ratio, difference) + sign * (std::cos(z) - ratio * std::sin(z));
}

/// Rigid motions, mean square 1; s = x/L from the kind's first end.
double rigid_shape(Kind kind, std::size_t k, double s) {
    if (kind == Kind::FreeFree && k == 0) return 1;
    return std::numbers::sqrt3 * (kind == Kind::FreeFree ? 1 - 2 * s : 1 - s);
}

struct PlateMode {
    std::size_t m = 1;
    std::size_t n = 1;
    double frequency_hz = 0;
};

/// The `count` lowest modes. A frequency below which there are that many bounds m and n.
std::vector<PlateMode> lowest_modes(const Plate& plate) {
    const double rigidity = plate.youngs_modulus_Pa * square(plate.thickness_m) * plate.thickness_m /
                            (12 * (1 - square(plate.poissons_ratio)));
    const double scale =
        std::numbers::pi / 2 * std::sqrt(rigidity / (plate.density_kg_per_m3 * plate.thickness_m));
    const double a = plate.size_m[0], b = plate.size_m[1];
    const auto frequency = [&](std::size_t m, std::size_t n) {
        return scale * (square(static_cast<double>(m) / a) + square(static_cast<double>(n) / b));
    };
    // In m^2/a^2 + n^2/b^2 < r^2 there are about pi a b r^2/4 - (a + b) r/2 modes: r is raised
    // until there are enough.
    std::vector<PlateMode> modes;
    for (double radius = 1 / std::min(a, b); modes.size() < plate.count; radius *= 1.5) {
        modes.clear();
        for (std::size_t m = 1; static_cast<double>(m) / a <= radius; ++m) {
            for (std::size_t n = 1;
                 square(static_cast<double>(m) / a) + square(static_cast<double>(n) / b) <= square(radius);
                 ++n) {
                modes.push_back({m, n, frequency(m, n)});
            }
        }
    }
    std::sort(modes.begin(), modes.end(), [](const PlateMode& left, const PlateMode& right) {
        if (left.frequency_hz != right.frequency_hz) return left.frequency_hz < right.frequency_hz;
        return left.m < right.m;
    });
    modes.resize(plate.count);
    return modes;
}

}  // namespace

double bar_root(std::array<BarEnd, 2> ends, std::size_t k) {
    JAWARI_ASSERT(k >= 1);
    return root_of(held(ends).kind, k);
}

std::size_t rigid_modes(std::array<BarEnd, 2> ends) {
    const Kind kind = held(ends).kind;
    if (kind == Kind::FreeFree) return 2;
    return kind == Kind::FreePinned ? 1 : 0;
}

ModeTable bar_modes(const Bar& bar) {
    const Loss loss = loss_of(bar.damping);
    const double scale =
        std::sqrt(bar.bending_stiffness_N_m2 / bar.linear_density_kg_per_m) / (2 * std::numbers::pi);
    const std::size_t rigid = rigid_modes(bar.ends);
    ModeTable table;
    for (std::size_t k = 0; k < bar.count; ++k) {
        const double wavenumber = k < rigid ? 0 : bar_root(bar.ends, k - rigid + 1) / bar.length_m;
        append(table, scale * square(wavenumber), loss);
    }
    return table;
}

ShapeTable bar_shapes(const Bar& bar, std::span<const double> places_m) {
    const auto [kind, mirrored] = held(bar.ends);
    const std::size_t rigid = rigid_modes(bar.ends);
    ShapeTable table;
    table.modal_mass_kg.assign(bar.count, bar.linear_density_kg_per_m * bar.length_m);
    for (const double place : places_m) {
        const double s = (mirrored ? bar.length_m - place : place) / bar.length_m;
        std::vector<double>& values = table.points.emplace_back();
        for (std::size_t k = 0; k < bar.count; ++k) {
            if (k < rigid) {
                values.push_back(rigid_shape(kind, k, s));
                continue;
            }
            const double x = root_of(kind, k - rigid + 1);
            values.push_back(bending_shape(kind, x * s, x));
        }
    }
    return table;
}

ModeTable plate_modes(const Plate& plate) {
    const Loss loss = loss_of(plate.damping);
    ModeTable table;
    for (const PlateMode& mode : lowest_modes(plate)) append(table, mode.frequency_hz, loss);
    return table;
}

ShapeTable plate_shapes(const Plate& plate, std::span<const std::array<double, 2>> places_m) {
    const std::vector<PlateMode> modes = lowest_modes(plate);
    const auto [a, b] = plate.size_m;
    const double mass = plate.density_kg_per_m3 * plate.thickness_m * a * b;
    ShapeTable table;
    table.modal_mass_kg.assign(plate.count, mass / 4);
    for (const auto& [x, y] : places_m) {
        std::vector<double>& values = table.points.emplace_back();
        for (const PlateMode& mode : modes) {
            // mode_shape() carries sqrt(2/L).
            const double scale = std::sqrt(a * b) / 2;
            values.push_back(scale * mode_shape(mode.m, x, a) * mode_shape(mode.n, y, b));
        }
    }
    return table;
}

}  // namespace jawari
