#include "string/compile/contact_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "string/broad_phase/gap_bounds.h"
#include "string/contact/impact_law.h"
#include "string/kernels/mode_run.h"
#include "string/kernels/mode_sums.h"
#include "string/model/contact_response.h"

namespace jawari {
namespace {

/// Fewer contacts are not worth a table by distance.
constexpr std::size_t smallest_grid = 65;
constexpr std::size_t largest_grid_period = 4 * limits::contacts;

/// Contacts at x = j L/M, all from below: then phi(x) phi(x') depends on j - j' and j + j' alone, since
/// 2 sin a sin b = cos(a - b) - cos(a + b). Returns M, or 0.
std::size_t grid_intervals(const StringModel& model) {
    if (model.contact_count < smallest_grid) return 0;
    double spacing = model.length_m;
    for (std::size_t c = 0; c < model.contact_count; ++c) {
        if (model.contact_side[c] != Side::Below) return 0;
        if (c > 0) spacing = std::min(spacing, model.contact_position[c] - model.contact_position[c - 1]);
    }
    constexpr std::size_t most_intervals = largest_grid_period / 2;
    if (!(spacing > 0) || model.length_m / spacing > static_cast<double>(most_intervals)) return 0;
    const double intervals = std::round(model.length_m / spacing);
    for (const double x : model.contact_position) {
        const double node = x / model.length_m * intervals;
        if (std::abs(node - std::round(node)) > 1e-9) return 0;
    }
    return static_cast<std::size_t>(intervals);
}

/// out[d * out_stride + n] = sum_k amplitudes[n][k] cos(k pi d/M)/L, for d < 2M and n < count.
void cosine_table(const StringModel& model, std::size_t intervals, const AlignedVector<double>& amplitudes,
                  std::size_t count, double* out, std::size_t out_stride) {
    const std::size_t period = 2 * intervals;
    std::vector<double> cosine(period);
    for (std::size_t i = 0; i < period; ++i) {
        cosine[i] = std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(intervals)) /
                    model.length_m;
    }
    AlignedVector<double> row(model.stride, 0.0);
    for (std::size_t d = 0; d < period; ++d) {
        for (std::size_t k = 0; k < model.mode_count; ++k) row[k] = cosine[(k + 1) * d % period];
        kernels::row_products(count, model.stride, model.stride, amplitudes.data(), row.data(),
                              out + d * out_stride);
    }
}

void set_dense_compliance(StringModel& model) {
    model.compliance.assign(model.contact_count * model.contact_stride, 0.0);
    AlignedVector<double> response(model.stride);
    for (std::size_t c = 0; c < model.contact_count; ++c) {
        std::fill(response.begin(), response.end(), 0.0);
        kernels::add_impulse(model.stride, model.step_s * model.theta, model.mobility.data(),
                             model.contact_rows.data() + c * model.stride, response.data());
        kernels::row_products(model.contact_count, model.stride, model.stride, model.contact_rows.data(),
                              response.data(), model.compliance.data() + c * model.contact_stride);
    }
}

kernels::ModeRun run_of_unit_impulse(const StringModel& model, const AlignedVector<double>& impulse) {
    kernels::ModeRun run = kernels::frame_run(model);
    run.drivers = 1;
    run.impulses = impulse.data();
    run.impulse_stride = model.response_stride;
    return run;
}

void set_dense_responses(StringModel& model) {
    const std::size_t count = model.contact_count;
    model.response.assign((count * count + 1) * model.response_stride, 0.0);
    AlignedVector<double> impulse(model.response_stride, 0.0);
    impulse[0] = 1;
    std::vector<const double*> rows(count);
    for (std::size_t c = 0; c < count; ++c) rows[c] = model.contact_rows.data() + c * model.stride;
    AlignedVector<double> lanes(count * kernels::steps_per_run * lane_padding);
    for (std::size_t struck = 0; struck < count; ++struck) {
        AlignedVector<double> q(model.stride, 0.0), v(model.stride, 0.0), driver(model.stride, 0.0);
        kernels::add_impulse(model.stride, 1.0, model.mobility.data(), rows[struck], driver.data());
        const double* driver_row = driver.data();
        kernels::ModeRun run = run_of_unit_impulse(model, impulse);
        run.driver_rows = &driver_row;
        run.probes = count;
        run.probe_rows = rows.data();
        run.rates = model.response.data() + struck * count * model.response_stride;
        run.rate_stride = model.response_stride;
        run.lanes = lanes.data();
        run.q = q.data();
        run.v = v.data();
        kernels::run_modes(run);
    }
}

/// Step by step, so that impulses spread over all contacts at a time.
void set_step_responses(StringModel& model) {
    if (model.steps_per_frame > longest_step_response) return;
    const std::size_t count = model.contact_count;
    model.step_response.assign(model.steps_per_frame * count * model.contact_stride, 0.0);
    for (std::size_t struck = 0; struck < count; ++struck) {
        for (std::size_t c = 0; c < count; ++c) {
            const Response response = response_of(model, struck, c);
            for (std::size_t n = 0; n < model.steps_per_frame; ++n)
                model.step_response[(n * count + struck) * model.contact_stride + c] = response.direct[n];
        }
    }
}

void set_grid_responses(StringModel& model) {
    const std::size_t intervals = model.grid_intervals;
    AlignedVector<double> amplitudes(model.steps_per_frame * model.stride, 0.0);
    for (std::size_t k = 0; k < model.mode_count; ++k) {
        const double e = model.carry[k] + model.change[k];
        double v = model.mobility[k];
        double q = model.step_s * v;
        for (std::size_t n = 0; n < model.steps_per_frame; ++n) {
            amplitudes[n * model.stride + k] = v;
            v = e * v + model.restoring[k] * q;
            q += model.step_s * v;
        }
    }
    model.response.assign(2 * intervals * model.response_stride, 0.0);
    cosine_table(model, intervals, amplitudes, model.steps_per_frame, model.response.data(),
                 model.response_stride);
}

/// How far 1 N s at one contact can lower the gap of another within a frame, the law's lookahead included
/// [m/(N s)].
double largest_push(const StringModel& model, std::size_t struck, std::size_t contact) {
    const Response response = response_of(model, struck, contact);
    const double ahead = looks_ahead(model.law) ? 0.5 : 0.0;
    double rise = 0;
    double lowest = 0;
    for (std::size_t n = 0; n < model.steps_per_frame; ++n) {
        const double rate = response.direct[n] - response.mirrored[n];
        rise += model.step_s * rate;
        lowest = std::min({lowest, rise, rise + ahead * model.step_s * rate});
    }
    return -lowest;
}

}  // namespace

void set_compliance(StringModel& model) {
    model.contact_stride = padded(model.contact_count);
    model.grid_intervals = grid_intervals(model);
    if (model.grid_intervals == 0) {
        set_dense_compliance(model);
        return;
    }
    for (const double x : model.contact_position) {
        const double node = std::round(x / model.length_m * static_cast<double>(model.grid_intervals));
        model.grid_node.push_back(static_cast<std::uint32_t>(node));
    }
    AlignedVector<double> amplitudes(model.stride);
    for (std::size_t k = 0; k < model.stride; ++k)
        amplitudes[k] = model.step_s * model.theta * model.mobility[k];
    model.compliance.assign(2 * model.grid_intervals, 0.0);
    cosine_table(model, model.grid_intervals, amplitudes, 1, model.compliance.data(), 1);
}

void set_responses(StringModel& model) {
    const std::size_t count = model.contact_count;
    model.response_stride = padded(model.steps_per_frame);
    const std::size_t rows = model.grid_node.empty() ? count * count + 1 : 2 * model.grid_intervals;
    if (count == 0 || rows * model.response_stride > largest_response_table) return;
    if (model.grid_node.empty()) {
        set_dense_responses(model);
        set_step_responses(model);
    } else {
        set_grid_responses(model);
    }
    if (count <= contacts_with_own_bounds) model.certificate.push_speed = model.certificate.push;
    const std::vector<std::size_t>& begin = model.certificate.group_begin;
    for (std::size_t g = 0; g + 1 < begin.size(); ++g) {
        for (std::size_t struck = 0; struck < count; ++struck) {
            double& push = model.certificate.push[g * count + struck];
            push = 0;
            for (std::size_t c = begin[g]; c < begin[g + 1]; ++c)
                push = std::max(push, largest_push(model, struck, c));
        }
    }
}

}  // namespace jawari
