#include "modal_rivals.h"

#include <cmath>
#include <stdexcept>

#include "hunt_crossley.h"
#include "jawari/scene/compile.h"
#include "repeat.h"

namespace jawari::rivals {
namespace {

constexpr double reference_penetration_m = 1e-6;
constexpr double smallest_restitution = 0.05;

double dot(std::size_t n, const double* a, const double* b) {
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t k = 0; k < n; ++k) sum += a[k] * b[k];
    return sum;
}

PowerLaw law_of(const StringModel& model, const ModalContactOptions& options) {
    double largest = 0;
    for (std::size_t c = 0; c < model.shape->contact_count; ++c) {
        const double* S = model.shape->contact_rows.data() + c * model.shape->stride;
        double inverse_mass = 0;
        for (std::size_t k = 0; k < model.shape->stride; ++k)
            inverse_mass += S[k] * S[k] * model.shape->mobility[k];
        largest = std::max(largest, inverse_mass);
    }
    const double h = model.shape->step_s;
    return {options.relative_stiffness / (h * h * largest) /
                std::pow(reference_penetration_m, options.exponent - 1),
            options.exponent};
}

/// One string whose contacts are solved by `Contacts`.
template <class Contacts>
class ModalString {
  public:
    ModalString(const StringModel& model, Contacts contacts) : model_(model), contacts_(std::move(contacts)) {
        const std::size_t n = model.shape->contact_count;
        coupling_.resize(n * n);
        std::vector<double> moved(model.shape->stride);
        for (std::size_t c = 0; c < n; ++c) {
            for (std::size_t k = 0; k < model.shape->stride; ++k)
                moved[k] = row(c)[k] * model.shape->mobility[k];
            for (std::size_t d = 0; d < n; ++d) {
                coupling_[c * n + d] = model.shape->step_s * model.shape->step_s *
                                       dot(model.shape->stride, row(d), moved.data());
            }
        }
    }

    void start() {
        const std::size_t n = model_.shape->contact_count;
        q_.assign(model_.shape->initial_displacement.begin(), model_.shape->initial_displacement.end());
        v_.assign(model_.shape->initial_velocity.begin(), model_.shape->initial_velocity.end());
        now_.resize(n);
        before_.resize(n);
        free_.resize(n);
        force_.assign(n, 0);
        for (std::size_t c = 0; c < n; ++c) {
            now_[c] = model_.shape->contact_height[c] - dot(model_.shape->stride, row(c), q_.data());
            before_[c] = now_[c] + model_.shape->step_s * dot(model_.shape->stride, row(c), v_.data());
        }
        contacts_.start(now_);
    }

    void step() {
        const std::size_t modes = model_.shape->stride, n = model_.shape->contact_count;
        const double h = model_.shape->step_s;
        const double* carry = model_.shape->carry.data();
        const double* change = model_.shape->change.data();
        const double* restoring = model_.tuning.restoring.data();
        double* q = q_.data();
        double* v = v_.data();
#pragma omp simd
        for (std::size_t k = 0; k < modes; ++k) {
            v[k] = carry[k] * v[k] + (change[k] * v[k] + restoring[k] * q[k]);
        }
        for (std::size_t c = 0; c < n; ++c) free_[c] = now_[c] - h * dot(modes, row(c), v);
        contacts_.solve(now_, before_, free_, coupling_, force_);
        bool pushed = false;
        for (std::size_t c = 0; c < n; ++c) {
            if (force_[c] == 0) continue;
            pushed = true;
            const double* S = row(c);
            const double* mobility = model_.shape->mobility.data();
            const double impulse = h * force_[c];
#pragma omp simd
            for (std::size_t k = 0; k < modes; ++k) v[k] += mobility[k] * S[k] * impulse;
        }
#pragma omp simd
        for (std::size_t k = 0; k < modes; ++k) q[k] += h * v[k];
        if (pushed) {
            for (std::size_t c = 0; c < n; ++c) {
                for (std::size_t d = 0; d < n; ++d) free_[c] -= coupling_[c * n + d] * force_[d];
            }
        }
        std::swap(before_, now_);
        std::swap(now_, free_);
    }

    [[nodiscard]] std::size_t probes() const {
        return model_.shape->probes.size();
    }
    [[nodiscard]] double probe(std::size_t p) const {
        return dot(model_.shape->stride, model_.shape->probe_rows.data() + p * model_.shape->stride,
                   q_.data());
    }

  private:
    [[nodiscard]] const double* row(std::size_t c) const {
        return model_.shape->contact_rows.data() + c * model_.shape->stride;
    }

    const StringModel& model_;
    Contacts contacts_;
    std::vector<double> coupling_;  ///< h^2 D [m/N]
    std::vector<double> q_, v_;
    std::vector<double> now_, before_, free_, force_;  ///< penetrations [m] and forces [N]
};

/// `contacts_of(model)` makes the contacts of one string.
template <class Contacts, class Make>
benchmarks::Trajectory run_modal(const SceneDescription& scene, double duration_s,
                                 const benchmarks::Repetition& repetition, Make&& contacts_of) {
    const double compile_start = host::thread_cpu_s();
    const auto compiled = compile(scene);
    if (!compiled) throw std::runtime_error(compiled.failure().line());
    const SceneModel& model = compiled.value();
    std::vector<ModalString<Contacts>> strings;
    strings.reserve(model.strings.size());
    benchmarks::Trajectory result;
    for (const StringModel& string : model.strings) {
        strings.emplace_back(string, contacts_of(string));
        result.unknowns += string.shape->mode_count;
    }
    result.compile_s = host::thread_cpu_s() - compile_start;
    result.rows = static_cast<std::size_t>(std::llround(duration_s * scene.output_rate_hz)) + 1;
    result.probes = model.probe_count;
    result.samples.resize(result.rows * result.probes);
    const auto start = [&] {
        for (auto& string : strings) string.start();
    };
    const auto run = [&] {
        double* out = result.samples.data();
        for (std::size_t r = 0; r < result.rows; ++r) {
            for (auto& string : strings) {
                for (std::size_t p = 0; p < string.probes(); ++p) *out++ = string.probe(p);
                if (r + 1 == result.rows) continue;
                for (std::size_t s = 0; s < model.steps_per_frame; ++s) string.step();
            }
        }
    };
    result.render_s = benchmarks::least_cpu_s(repetition, start, run);
    return result;
}

}  // namespace

benchmarks::Trajectory run_penalty(const SceneDescription& scene, double duration_s,
                                   const ModalContactOptions& options,
                                   const benchmarks::Repetition& repetition) {
    return run_modal<HuntCrossleyContacts>(scene, duration_s, repetition, [&](const StringModel& model) {
        std::vector<double> damping;
        for (const double e : model.shape->contact_restitution) {
            const double reachable = std::max(e, smallest_restitution);
            damping.push_back(reachable < 1 ? damping_of_restitution(reachable, options.restitution_speed)
                                            : 0);
        }
        return HuntCrossleyContacts(law_of(model, options), std::move(damping), model.shape->step_s);
    });
}

benchmarks::Trajectory run_quadratised_modal(const SceneDescription& scene, double duration_s,
                                             const ModalContactOptions& options,
                                             const benchmarks::Repetition& repetition) {
    return run_modal<QuadratisedContacts>(scene, duration_s, repetition, [&](const StringModel& model) {
        return QuadratisedContacts(law_of(model, options), model.shape->contact_count, Auxiliary::PerContact);
    });
}

}  // namespace jawari::rivals
