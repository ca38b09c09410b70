#include "instrument/touch/exciters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "instrument/touch/touches.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

constexpr double pi = std::numbers::pi;

/// Of a hammer's compression: enough for halvings alone to reach the last bits of a double.
constexpr int most_iterations = 60;
/// Share of the compression up to which its change is small.
constexpr double small_change = 0.01;
/// Exponents up to half of this, in halves, need no power.
constexpr double most_halves = 16;
/// A hammer that has not met the string, or not left it, by then is taken away [s].
constexpr double longest_stroke_s = 0.1;

// ---------------------------------------------------------------------------------------------- noise

/// Of the grid on which noises are random.
constexpr double noise_rate_hz = 24000;
/// A sum (1-f) a + f b of numbers that are uniform in -1 to 1 has the variance 2/9, over all f.
constexpr double rms_of_noise = 0.47140452079103168;
/// Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, OOPSLA 2014: SplitMix64.
constexpr std::uint64_t golden_gamma = 0x9e3779b97f4a7c15;

std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

/// Uniform in -1 to 1.
double sample(std::uint64_t seed, std::uint64_t index) {
    return static_cast<double>(mixed(seed + (index + 1) * golden_gamma) >> 11) * 0x1p-52 - 1;
}

// ---------------------------------------------------------------------------------------------- finger

/// Integral of half a cosine's rise from 0 to x.
double half_cosine_area(double x) {
    return x / 2 - std::sin(pi * x) / (2 * pi);
}

double finger_force(double frame_s, ExciterState& exciter) {
    double share = finger_shape(exciter.frame, exciter.rise_frames, exciter.release_frames);
    if (exciter.roughness > 0) {
        const double middle_s = (static_cast<double>(exciter.frame) + 0.5) * frame_s;
        share *= 1 + exciter.roughness * noise_at(exciter.seed, middle_s);
    }
    exciter.frame += 1;
    if (exciter.frame >= exciter.rise_frames + exciter.release_frames) exciter.phase = ExciterPhase::None;
    return exciter.peak * share;
}

// ---------------------------------------------------------------------------------------------- hammer

/// x^p; multiples of a half, as felts and fingers have them, by products.
double power(double x, double exponent) {
    const double halves = 2 * exponent;
    if (halves != std::floor(halves) || halves > most_halves) return std::pow(x, exponent);
    const auto count = static_cast<unsigned>(halves);
    double result = count % 2 == 1 ? std::sqrt(x) : 1.0;
    for (unsigned i = 0; i < count / 2; ++i) result *= x;
    return result;
}

double felt_force(const ExciterState& hammer, double compression) {
    return compression > 0 ? hammer.stiffness * power(compression, hammer.exponent) : 0.0;
}

/// V at a compression whose force is known: K xi^(p+1)/(p+1).
double felt_potential(const ExciterState& hammer, double compression, double force) {
    return force * compression / (hammer.exponent + 1);
}

/// ((1 + r)^p - 1)/r for |r| < small_change, by nine terms of the binomial series: the tenth is below the
/// rounding of 1.
double growth_per_share(double r, double p) {
    // A quotient for each would cost more than all of the rest.
    constexpr std::array<double, 8> per_number{1.0 / 9, 1.0 / 8, 1.0 / 7, 1.0 / 6,
                                               1.0 / 5, 1.0 / 4, 1.0 / 3, 1.0 / 2};
    double sum = 1;
    double number = per_number.size();
    for (const double share : per_number) {
        sum = 1 + sum * r * (p - number) * share;
        number -= 1;
    }
    return p * sum;
}

/// The felt at the frame's start.
struct FeltStep {
    double before = 0;          ///< xi
    double force = 0;           ///< K xi^p
    double potential = 0;       ///< V(xi)
    double loss_per_metre = 0;  ///< K xi^p loss/T
};

/// A force and how it changes with the compression.
struct FeltForce {
    double force_N = 0;
    double stiffness_N_per_m = 0;
};

/// The discrete gradient of the potential, with the loss, at the compression at the frame's end. It rises
/// with the compression.
FeltForce felt_force_over(const ExciterState& hammer, const FeltStep& step, double after) {
    const double change = after - step.before;
    FeltForce felt;
    if (step.before > 0 && std::abs(change) < small_change * step.before) {
        // The difference of the potentials without its cancellation.
        felt.force_N =
            step.potential / step.before * growth_per_share(change / step.before, hammer.exponent + 1);
        felt.stiffness_N_per_m = hammer.exponent * step.force / (2 * step.before);
    } else if (change != 0) {
        const double force = felt_force(hammer, after);
        felt.force_N = (felt_potential(hammer, after, force) - step.potential) / change;
        felt.stiffness_N_per_m = (force - felt.force_N) / change;
    }
    felt.force_N += step.loss_per_metre * change;
    felt.stiffness_N_per_m += step.loss_per_metre;
    return felt.force_N > 0 ? felt : FeltForce{};
}

/// A compression at the frame's end, and the force over the frame.
struct Compression {
    double after = 0;
    double force_N = 0;
};

/// xi+ = free - give F(xi+): the left side less the right rises with xi+. Newton's method from the
/// compression at the frame's start, where the force is known, and halvings of the bracket where it would
/// leave that.
Compression solve_compression(const ExciterState& hammer, const FeltStep& step, double free_m, double give) {
    double high = free_m;  // F >= 0
    double low = std::min(0.0, std::min(free_m, step.before)) - std::sqrt(give * step.potential);
    Compression found{step.before > low && step.before < high ? step.before : free_m, 0};
    for (int i = 0; i < most_iterations; ++i) {
        const FeltForce felt = felt_force_over(hammer, step, found.after);
        found.force_N = felt.force_N;
        const double excess = found.after - free_m + give * felt.force_N;
        if (excess == 0) break;
        (excess > 0 ? high : low) = found.after;
        double next = found.after - excess / (1 + give * felt.stiffness_N_per_m);
        if (!(next > low && next < high)) next = low + (high - low) / 2;
        const double move = std::abs(next - found.after);
        if (move <= std::numeric_limits<double>::epsilon() * std::abs(next)) break;
        found.after = next;
    }
    return found;
}

double hammer_force(const StringAtExciter& at, ExciterState& hammer) {
    const double T = at.frame_s;
    FeltStep step;
    step.before = hammer.position_m - at.displacement_m;
    step.force = felt_force(hammer, step.before);
    step.potential = felt_potential(hammer, step.before, step.force);
    step.loss_per_metre = hammer.loss_s_per_m * step.force / T;
    const double give = T * T / (2 * hammer.mass_kg) + at.give_m_per_N;
    const double free_m = hammer.position_m + T * hammer.speed_m_per_s - (at.displacement_m + at.rise_m);
    const auto [after, force] = solve_compression(hammer, step, free_m, give);
    hammer.position_m += T * hammer.speed_m_per_s - T * T * force / (2 * hammer.mass_kg);
    hammer.speed_m_per_s -= T * force / hammer.mass_kg;
    hammer.has_touched = hammer.has_touched || force > 0;
    hammer.frame += 1;
    const bool leaves = hammer.has_touched && after < 0 && after < step.before;
    const bool too_long = static_cast<double>(hammer.frame) * T > longest_stroke_s;
    if (leaves || too_long || !std::isfinite(hammer.position_m)) hammer.phase = ExciterPhase::None;
    return std::isfinite(force) ? force : 0.0;
}

// ---------------------------------------------------------------------------------------------- tangent

/// b'(t) = height/rise (1 - cos(2 pi t/rise)); the mean of b'' over a frame is the change of b' over it.
double tangent_force(double frame_s, ExciterState& tangent) {
    const auto rise = static_cast<double>(tangent.rise_frames);
    const auto speed = [&](double frame) {
        return tangent.peak / (rise * frame_s) * (1 - std::cos(2 * pi * frame / rise));
    };
    const auto n = static_cast<double>(tangent.frame);
    const double force = -(speed(n + 1) - speed(n)) / frame_s;
    tangent.frame += 1;
    if (tangent.frame >= tangent.rise_frames) tangent.phase = ExciterPhase::None;
    return force;
}

void begin(ExciterState& exciter, ExciterPhase phase) {
    exciter.phase = phase;
    exciter.frame = 0;
    exciter.has_touched = false;
    exciter.roughness = 0;
    exciter.point = {};
}

}  // namespace

double noise_at(std::uint64_t seed, double time_s) JAWARI_REALTIME {
    const double place = time_s * noise_rate_hz;
    const double before = std::floor(place);
    const auto index = static_cast<std::uint64_t>(before);
    const double past = place - before;
    return ((1 - past) * sample(seed, index) + past * sample(seed, index + 1)) / rms_of_noise;
}

std::uint64_t next_noise(const StringModel& model, TouchState& touches) JAWARI_REALTIME {
    touches.noises += 1;
    return mixed(std::bit_cast<std::uint64_t>(model.tuning.omega[0]) + touches.noises * golden_gamma);
}

std::uint64_t frames_of(double seconds, double rate_hz) JAWARI_REALTIME {
    return static_cast<std::uint64_t>(std::max(1.0, std::ceil(seconds * rate_hz)));
}

double finger_shape(std::uint64_t n, std::uint64_t rise_frames,
                    std::uint64_t release_frames) JAWARI_REALTIME {
    const auto mean = [](double from, double to, double frames) {
        return (half_cosine_area(to / frames) - half_cosine_area(from / frames)) * frames;
    };
    const auto rise = static_cast<double>(rise_frames);
    const auto release = static_cast<double>(release_frames);
    const auto at = static_cast<double>(n);
    if (n < rise_frames) return mean(at, at + 1, rise);
    if (n < rise_frames + release_frames) return mean(rise + release - at - 1, rise + release - at, release);
    return 0;
}

double exciter_force(const StringAtExciter& at, ExciterState& exciter) JAWARI_REALTIME {
    switch (exciter.phase) {
        case ExciterPhase::Finger:
            return finger_force(at.frame_s, exciter);
        case ExciterPhase::Hammer:
            return hammer_force(at, exciter);
        case ExciterPhase::Tangent:
            return tangent_force(at.frame_s, exciter);
        case ExciterPhase::None:
            break;
    }
    return 0;
}

void begin_finger(const StringModel& model, ExciterState& exciter, double x, double width_m, double peak_N,
                  std::uint64_t rise_frames, std::uint64_t release_frames) JAWARI_REALTIME {
    begin(exciter, ExciterPhase::Finger);
    write_point_row(model, model.shape->stride, x, width_m, exciter.row.data());
    exciter.peak = peak_N;
    exciter.rise_frames = rise_frames;
    exciter.release_frames = release_frames;
}

void begin_hammer(const StringModel& model, const StringState& string, ExciterState& exciter, double x,
                  double width_m, const HammerDescription& hammer, double speed_m_per_s,
                  double hardness) JAWARI_REALTIME {
    begin(exciter, ExciterPhase::Hammer);
    write_point_row(model, model.shape->stride, x, width_m, exciter.row.data());
    if (hammer.side == Side::Above) {  // the same in a world upside down
        for (std::size_t k = 0; k < model.shape->stride; ++k) exciter.row[k] = -exciter.row[k];
    }
    double q = 0;
    double v = 0;
    kernels::row_products(1, model.shape->stride, model.shape->stride, exciter.row.data(),
                          string.displacement.data(), &q);
    kernels::row_products(1, model.shape->stride, model.shape->stride, exciter.row.data(),
                          string.velocity.data(), &v);
    exciter.position_m = q - model.shape->step_s / 2 * v;
    exciter.speed_m_per_s = speed_m_per_s;
    exciter.mass_kg = hammer.mass_kg;
    exciter.stiffness = hammer.stiffness * hardness;
    exciter.exponent = hammer.exponent;
    exciter.loss_s_per_m = hammer.loss_s_per_m;
}

/// u = b (1 - x/L) + sum phi_k q_k: the modes feel -mu b'' times the integral of (1 - x/L) phi_k,
/// sqrt(2 L)/(k pi).
void begin_tangent(const StringModel& model, ExciterState& exciter, double height_m,
                   std::uint64_t rise_frames) JAWARI_REALTIME {
    begin(exciter, ExciterPhase::Tangent);
    const double scale = std::sqrt(2 * model.shape->length_m) / pi;
    for (std::size_t k = 0; k < model.shape->stride; ++k)
        exciter.row[k] = k < model.shape->mode_count ? scale / static_cast<double>(k + 1) : 0.0;
    exciter.peak = model.shape->linear_density_kg_per_m * height_m;
    exciter.rise_frames = rise_frames;
}

}  // namespace jawari
