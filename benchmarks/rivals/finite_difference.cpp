#include "finite_difference.h"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "jawari/scene/modes.h"
#include "repeat.h"

namespace jawari::rivals {
namespace {

constexpr double reference_penetration_m = 1e-6;

/// Value at a position between grid points, by a cubic through four of them.
struct Interpolation {
    std::size_t first = 0;  ///< index in the padded grid
    std::array<double, 4> weight{};

    [[nodiscard]] double of(const double* u) const {
        double sum = 0;
        for (std::size_t i = 0; i < 4; ++i) sum += weight[i] * u[first + i];
        return sum;
    }
};

/// u is padded: u[0] = -u[2] and u[1] = 0 at the left end, alike at the right; intervals of width dx.
struct Grid {
    std::size_t intervals = 0;
    double dx = 0;

    [[nodiscard]] std::size_t padded() const { return intervals + 3; }
    [[nodiscard]] Interpolation at(double x) const {
        const double place = x / dx;
        const double cell = std::min(std::floor(place), static_cast<double>(intervals) - 1);
        const double a = place - cell;
        return {static_cast<std::size_t>(cell),
                {-a * (a - 1) * (a - 2) / 6, (a + 1) * (a - 1) * (a - 2) / 2, -(a + 1) * a * (a - 2) / 2,
                 (a + 1) * a * (a - 1) / 6}};
    }
};

double overlap(const Interpolation& a, const Interpolation& b) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            if (a.first + i == b.first + j) sum += a.weight[i] * b.weight[j];
        }
    }
    return sum;
}

Grid finest_grid(const StiffString& string, double k) {
    const double intervals = std::floor(string.length_m / smallest_spacing(string, k));
    if (intervals < 4) throw std::runtime_error("the contact rate leaves fewer than four grid intervals");
    return {static_cast<std::size_t>(intervals), string.length_m / intervals};
}

class FiniteDifferenceString {
  public:
    FiniteDifferenceString(const StringDescription& description, double k, const QuadratisedOptions& options)
        : string_(stiff_string(description)),
          grid_(finest_grid(string_, k)),
          k_(k),
          contacts_({}, 0, options.auxiliary) {
        set_stencil();
        for (const ContactDescription& contact : description.contacts) {
            side_.push_back(contact.side == Side::Below ? 1.0 : -1.0);
            height_.push_back(contact.height_m);
            place_.push_back(grid_.at(contact.position_m));
        }
        for (const ProbeDescription& probe : description.probes) {
            probe_.push_back(grid_.at(probe.position_m));
        }
        const double inertia = string_.density_kg_per_m * grid_.dx;
        const double stiffness = options.relative_stiffness * inertia / (k * k) /
                                 std::pow(reference_penetration_m, options.exponent - 1);
        contacts_ = QuadratisedContacts({stiffness, options.exponent}, place_.size(), options.auxiliary);
        set_coupling();
        set_initial_shape(description);
    }

    [[nodiscard]] std::size_t points() const { return grid_.intervals - 1; }
    [[nodiscard]] std::size_t probes() const { return probe_.size(); }
    [[nodiscard]] double probe(std::size_t p) const { return probe_[p].of(now_.data()); }

    void start() {
        now_ = initial_;
        before_ = initial_;
        free_.assign(grid_.padded(), 0);
        // At rest: u(-k) = u(k) = u + k^2/2 u_tt.
        std::vector<double> accelerated = initial_;
        for (std::size_t i = 2; i < grid_.padded() - 2; ++i) {
            const double curve = initial_[i - 1] - 2 * initial_[i] + initial_[i + 1];
            accelerated[i] += (courant_ * curve - bending_ * fourth(initial_.data(), i)) / 2;
        }
        before_ = accelerated;
        mirror(before_);
        const std::size_t n = place_.size();
        p_now_.resize(n);
        p_before_.resize(n);
        p_free_.resize(n);
        force_.assign(n, 0);
        penetrations(before_, p_before_);
        penetrations(now_, p_now_);
        contacts_.start(p_now_);
    }

    void step() {
        const std::size_t end = grid_.padded() - 2;
        const double* u = now_.data();
        const double* b = before_.data();
        double* next = free_.data();
        const double c0 = weight_[0], c1 = weight_[1], c2 = weight_[2], b0 = weight_[3], b1 = weight_[4];
#pragma omp simd
        for (std::size_t i = 2; i < end; ++i) {
            next[i] = c0 * u[i] + c1 * (u[i - 1] + u[i + 1]) + c2 * (u[i - 2] + u[i + 2]) + b0 * b[i] +
                      b1 * (b[i - 1] + b[i + 1]);
        }
        mirror(free_);
        penetrations(free_, p_free_);
        contacts_.solve(p_now_, p_before_, p_free_, coupling_, force_);
        bool pushed = false;
        for (std::size_t c = 0; c < place_.size(); ++c) {
            if (force_[c] == 0) continue;
            pushed = true;
            for (std::size_t i = 0; i < 4; ++i) {
                free_[place_[c].first + i] += side_[c] * spread_ * place_[c].weight[i] * force_[c];
            }
        }
        if (pushed) {
            mirror(free_);
            penetrations(free_, p_free_);
        }
        std::swap(before_, now_);
        std::swap(now_, free_);
        std::swap(p_before_, p_now_);
        std::swap(p_now_, p_free_);
    }

  private:
    static double fourth(const double* u, std::size_t i) {
        return u[i - 2] - 4 * u[i - 1] + 6 * u[i] - 4 * u[i + 1] + u[i + 2];
    }

    /// u[1] = 0 = u[1 + intervals] are the ends; the points beyond mirror those inside (pinned).
    void mirror(std::vector<double>& u) const {
        const std::size_t last = 1 + grid_.intervals;
        u[1] = 0;
        u[last] = 0;
        u[0] = -u[2];
        u[last + 1] = -u[last - 1];
    }

    void penetrations(const std::vector<double>& u, std::vector<double>& p) const {
        for (std::size_t c = 0; c < place_.size(); ++c)
            p[c] = side_[c] * (height_[c] - place_[c].of(u.data()));
    }

    void set_stencil() {
        const double dx = grid_.dx;
        courant_ = std::pow(string_.wave_speed * k_ / dx, 2);
        bending_ = std::pow(string_.stiffness * k_ / (dx * dx), 2);
        const double curve_loss = 2 * string_.loss_curve * k_ / (dx * dx);
        const double left = 1 + string_.loss * k_;
        weight_ = {(2 - 2 * courant_ - 6 * bending_ - 2 * curve_loss) / left,
                   (courant_ + 4 * bending_ + curve_loss) / left, -bending_ / left,
                   (-1 + string_.loss * k_ + 2 * curve_loss) / left, -curve_loss / left};
        spread_ = k_ * k_ / (string_.density_kg_per_m * dx * left);
    }

    void set_coupling() {
        const std::size_t n = place_.size();
        coupling_.resize(n * n);
        for (std::size_t c = 0; c < n; ++c) {
            for (std::size_t d = 0; d < n; ++d) {
                coupling_[c * n + d] = spread_ * side_[c] * side_[d] * overlap(place_[c], place_[d]);
            }
        }
    }

    /// The same modes as in the scene, as far as the grid has them.
    void set_initial_shape(const StringDescription& description) {
        const auto& pluck = std::get<Pluck>(description.initial.shape);
        const std::size_t modes =
            std::min(std::get<PhysicalModes>(description.modes).count, grid_.intervals - 1);
        initial_.assign(grid_.padded(), 0);
        for (std::size_t k = 1; k <= modes; ++k) {
            const double q = pluck_coordinate(k, pluck, string_.length_m);
            for (std::size_t j = 1; j < grid_.intervals; ++j) {
                initial_[1 + j] += q * mode_shape(k, static_cast<double>(j) * grid_.dx, string_.length_m);
            }
        }
        mirror(initial_);
    }

    StiffString string_;
    Grid grid_;
    double k_ = 0;
    double courant_ = 0;              ///< (c k/dx)^2
    double bending_ = 0;              ///< (kappa k/dx^2)^2
    std::array<double, 5> weight_{};  ///< of u[i], u[i+-1], u[i+-2] now, of u[i], u[i+-1] before
    double spread_ = 0;               ///< displacement of a grid point per newton and step [m/N]
    std::vector<double> side_, height_;
    std::vector<Interpolation> place_, probe_;
    std::vector<double> coupling_;
    QuadratisedContacts contacts_;
    std::vector<double> initial_, now_, before_, free_;
    std::vector<double> p_now_, p_before_, p_free_, force_;
};

}  // namespace

StiffString stiff_string(const StringDescription& description) {
    const auto* physical = std::get_if<PhysicalModes>(&description.modes);
    if (physical == nullptr || !std::holds_alternative<Pluck>(description.initial.shape)) {
        throw std::runtime_error("the finite-difference string needs modes from physics and a pluck");
    }
    StiffString string;
    string.length_m = description.length_m;
    string.density_kg_per_m = description.linear_density_kg_per_m;
    string.wave_speed = std::sqrt(physical->tension_N / description.linear_density_kg_per_m);
    string.stiffness =
        string.wave_speed * string.length_m * std::sqrt(physical->inharmonicity) / std::numbers::pi;
    // sigma_k = s0 + s1 (k pi/L)^2; normal equations with weights 1/sigma_k^2.
    const Modes modes = modes_of(description);
    double w = 0, x = 0, xx = 0, y = 0, xy = 0;
    for (std::size_t k = 0; k < modes.omega.size() && modes.omega[k] < 2 * std::numbers::pi * 5000; ++k) {
        if (modes.sigma[k] == 0) continue;
        const double weight = 1 / (modes.sigma[k] * modes.sigma[k]);
        const double square = std::pow(static_cast<double>(k + 1) * std::numbers::pi / string.length_m, 2);
        w += weight;
        x += weight * square;
        xx += weight * square * square;
        y += weight * modes.sigma[k];
        xy += weight * square * modes.sigma[k];
    }
    const double determinant = w * xx - x * x;
    if (determinant > 0) {
        string.loss_curve = std::max(0.0, (w * xy - x * y) / determinant);
        string.loss = (y - string.loss_curve * x) / w;
    }
    return string;
}

double smallest_spacing(const StiffString& string, double k) {
    const double a = std::pow(string.wave_speed * k, 2) + 4 * string.loss_curve * k;
    return std::sqrt((a + std::sqrt(a * a + 16 * std::pow(string.stiffness * k, 2))) / 2);
}

benchmarks::Trajectory run_quadratised(const SceneDescription& scene, double duration_s,
                                       const QuadratisedOptions& options,
                                       const benchmarks::Repetition& repetition) {
    const double compile_start = host::thread_cpu_s();
    std::vector<FiniteDifferenceString> strings;
    benchmarks::Trajectory result;
    for (const StringDescription& string : scene.strings) {
        strings.emplace_back(string, 1 / scene.contact_rate_hz, options);
        result.unknowns += strings.back().points();
        result.probes += strings.back().probes();
    }
    result.compile_s = host::thread_cpu_s() - compile_start;
    result.rows = static_cast<std::size_t>(std::llround(duration_s * scene.output_rate_hz)) + 1;
    result.samples.resize(result.rows * result.probes);
    const auto steps = static_cast<std::size_t>(std::llround(scene.contact_rate_hz / scene.output_rate_hz));
    result.render_s = benchmarks::least_cpu_s(
        repetition,
        [&] {
            for (FiniteDifferenceString& string : strings) string.start();
        },
        [&] {
            double* out = result.samples.data();
            for (std::size_t row = 0; row < result.rows; ++row) {
                for (FiniteDifferenceString& string : strings) {
                    for (std::size_t p = 0; p < string.probes(); ++p) *out++ = string.probe(p);
                    if (row + 1 == result.rows) continue;
                    for (std::size_t s = 0; s < steps; ++s) string.step();
                }
            }
        });
    return result;
}

}  // namespace jawari::rivals
