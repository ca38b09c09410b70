#include "string/compile/contact_tables.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

#include "string/broad_phase/gap_bounds.h"
#include "string/contact/impact_law.h"
#include "string/kernels/mode_run.h"
#include "string/kernels/mode_sums.h"
#include "string/model/contact_response.h"
#include "string/solver/projected_gradients.h"

namespace jawari {
namespace {

/// Fewer contacts are not worth a table by distance.
constexpr std::size_t smallest_grid = 65;
constexpr std::size_t largest_grid_period = 4 * limits::contacts;

/// Contacts at x = j L/M, all from below: then phi(x) phi(x') depends on j - j' and j + j' alone, since
/// 2 sin a sin b = cos(a - b) - cos(a + b). Returns M, or 0.
std::size_t grid_intervals(const StringShape& shape) {
    if (shape.contact_count < smallest_grid) return 0;
    double spacing = shape.length_m;
    for (std::size_t c = 0; c < shape.contact_count; ++c) {
        if (shape.contact_side[c] != Side::Below) return 0;
        if (c > 0) spacing = std::min(spacing, shape.contact_position[c] - shape.contact_position[c - 1]);
    }
    constexpr std::size_t most_intervals = largest_grid_period / 2;
    if (!(spacing > 0) || shape.length_m / spacing > static_cast<double>(most_intervals)) return 0;
    const double intervals = std::round(shape.length_m / spacing);
    for (const double x : shape.contact_position) {
        const double node = x / shape.length_m * intervals;
        if (std::abs(node - std::round(node)) > 1e-9) return 0;
    }
    return static_cast<std::size_t>(intervals);
}

/// out[d * out_stride + n] = sum_k amplitudes[n][k] cos(k pi d/M)/L, for d < 2M and n < count.
void cosine_table(const StringShape& shape, std::size_t intervals, const AlignedVector<double>& amplitudes,
                  std::size_t count, double* out, std::size_t out_stride) {
    const std::size_t period = 2 * intervals;
    std::vector<double> cosine(period);
    for (std::size_t i = 0; i < period; ++i) {
        cosine[i] = std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(intervals)) /
                    shape.length_m;
    }
    AlignedVector<double> row(shape.stride, 0.0);
    for (std::size_t d = 0; d < period; ++d) {
        for (std::size_t k = 0; k < shape.mode_count; ++k) row[k] = cosine[(k + 1) * d % period];
        kernels::row_products(count, shape.stride, shape.stride, amplitudes.data(), row.data(),
                              out + d * out_stride);
    }
}

AlignedVector<double> dense_operator(const StringShape& shape, double scale,
                                     const AlignedVector<double>& weights) {
    AlignedVector<double> values(shape.contact_count * shape.contact_stride, 0.0);
    AlignedVector<double> response(shape.stride);
    for (std::size_t c = 0; c < shape.contact_count; ++c) {
        std::fill(response.begin(), response.end(), 0.0);
        kernels::add_impulse(shape.stride, scale, weights.data(),
                             shape.contact_rows.data() + c * shape.stride, response.data());
        kernels::row_products(shape.contact_count, shape.stride, shape.stride, shape.contact_rows.data(),
                              response.data(), values.data() + c * shape.contact_stride);
    }
    return values;
}

AlignedVector<double> grid_operator(const StringShape& shape, double scale,
                                    const AlignedVector<double>& weights) {
    AlignedVector<double> amplitudes(shape.stride);
    for (std::size_t k = 0; k < shape.stride; ++k) amplitudes[k] = scale * weights[k];
    const std::size_t period = 2 * shape.grid_intervals;
    AlignedVector<double> values(period + grid_repeats, 0.0);
    cosine_table(shape, shape.grid_intervals, amplitudes, 1, values.data(), 1);
    for (std::size_t d = period; d < values.size(); ++d) values[d] = values[d - period];
    return values;
}

/// FNV-1a over the numbers that make the operator, a word at a time.
std::uint64_t identity_of(const StringShape& shape) {
    std::uint64_t id = 0xcbf29ce484222325;
    const auto add = [&](std::uint64_t word) {
        id = (id ^ word) * 0x100000001b3;
        id ^= id >> 32;  // the product carries nothing downwards
    };
    add(shape.contact_count);
    for (const std::uint32_t node : shape.grid_node) add(node);
    for (const double value : shape.compliance) add(std::bit_cast<std::uint64_t>(value));
    return std::max<std::uint64_t>(id, 1);
}

kernels::ModeRun run_of_unit_impulse(const StringModel& model, const AlignedVector<double>& impulse) {
    kernels::ModeRun run = kernels::frame_run(model);
    run.drivers = 1;
    run.impulses = impulse.data();
    run.impulse_stride = model.shape->response_stride;
    return run;
}

void set_dense_responses(StringDraft& draft) {
    StringShape& shape = *draft.shape;
    StringTuning& tuning = draft.model.tuning;
    const std::size_t count = shape.contact_count;
    tuning.response.assign((count * count + 1) * shape.response_stride, 0.0);
    AlignedVector<double> impulse(shape.response_stride, 0.0);
    impulse[0] = 1;
    std::vector<const double*> rows(count);
    for (std::size_t c = 0; c < count; ++c) rows[c] = shape.contact_rows.data() + c * shape.stride;
    AlignedVector<double> lanes(count * kernels::steps_per_run * lane_padding);
    for (std::size_t struck = 0; struck < count; ++struck) {
        AlignedVector<double> q(shape.stride, 0.0), v(shape.stride, 0.0), driver(shape.stride, 0.0);
        kernels::add_impulse(shape.stride, 1.0, shape.mobility.data(), rows[struck], driver.data());
        const double* driver_row = driver.data();
        kernels::ModeRun run = run_of_unit_impulse(draft.model, impulse);
        run.driver_rows = &driver_row;
        run.probes = count;
        run.probe_rows = rows.data();
        run.rates = tuning.response.data() + struck * count * shape.response_stride;
        run.rate_stride = shape.response_stride;
        run.lanes = lanes.data();
        run.q = q.data();
        run.v = v.data();
        kernels::run_modes(run);
    }
}

/// Step by step, so that impulses spread over all contacts at a time.
void set_step_responses(StringDraft& draft) {
    StringShape& shape = *draft.shape;
    StringTuning& tuning = draft.model.tuning;
    if (shape.steps_per_frame > longest_step_response) return;
    const std::size_t count = shape.contact_count;
    tuning.step_response.assign(shape.steps_per_frame * count * shape.contact_stride, 0.0);
    for (std::size_t struck = 0; struck < count; ++struck) {
        for (std::size_t c = 0; c < count; ++c) {
            const Response response = response_of(draft.model, struck, c);
            for (std::size_t n = 0; n < shape.steps_per_frame; ++n)
                tuning.step_response[(n * count + struck) * shape.contact_stride + c] = response.direct[n];
        }
    }
}

void set_grid_responses(StringDraft& draft) {
    StringShape& shape = *draft.shape;
    StringTuning& tuning = draft.model.tuning;
    const std::size_t intervals = shape.grid_intervals;
    AlignedVector<double> amplitudes(shape.steps_per_frame * shape.stride, 0.0);
    for (std::size_t k = 0; k < shape.mode_count; ++k) {
        const double e = shape.carry[k] + shape.change[k];
        double v = shape.mobility[k];
        double q = shape.step_s * v;
        for (std::size_t n = 0; n < shape.steps_per_frame; ++n) {
            amplitudes[n * shape.stride + k] = v;
            v = e * v + tuning.restoring[k] * q;
            q += shape.step_s * v;
        }
    }
    tuning.response.assign(2 * intervals * shape.response_stride, 0.0);
    cosine_table(shape, intervals, amplitudes, shape.steps_per_frame, tuning.response.data(),
                 shape.response_stride);
}

/// How far 1 N s at one contact can lower the gap of another within a frame, the law's lookahead included
/// [m/(N s)].
double largest_push(const StringModel& model, std::size_t struck, std::size_t contact) {
    const Response response = response_of(model, struck, contact);
    const double ahead = looks_ahead(model.shape->law) ? 0.5 : 0.0;
    double rise = 0;
    double lowest = 0;
    for (std::size_t n = 0; n < model.shape->steps_per_frame; ++n) {
        const double rate = response.direct[n] - response.mirrored[n];
        rise += model.shape->step_s * rate;
        lowest = std::min({lowest, rise, rise + ahead * model.shape->step_s * rate});
    }
    return -lowest;
}

void set_grid(StringShape& shape) {
    shape.grid_intervals = grid_intervals(shape);
    if (shape.grid_intervals == 0) return;
    for (const double x : shape.contact_position) {
        const double node = std::round(x / shape.length_m * static_cast<double>(shape.grid_intervals));
        shape.grid_node.push_back(static_cast<std::uint32_t>(node));
    }
}

}  // namespace

AlignedVector<double> contact_operator(const StringShape& shape, double scale,
                                       const AlignedVector<double>& weights) {
    return shape.grid_intervals == 0 ? dense_operator(shape, scale, weights)
                                     : grid_operator(shape, scale, weights);
}

void set_compliance(StringShape& shape) {
    shape.contact_stride = padded(shape.contact_count);
    set_grid(shape);
    shape.compliance = contact_operator(shape, shape.step_s * shape.theta, shape.mobility);
    shape.compliance_id = identity_of(shape);
    if (shape.contact_count <= largest_factor) return;
    std::vector<std::uint32_t> contacts(shape.contact_count);
    std::iota(contacts.begin(), contacts.end(), 0U);
    shape.compliance_norm = bound_of_norm(compliance_of(shape), contacts);
}

void set_responses(StringDraft& draft) {
    StringShape& shape = *draft.shape;
    StringTuning& tuning = draft.model.tuning;
    const std::size_t count = shape.contact_count;
    shape.response_stride = padded(shape.steps_per_frame);
    const std::size_t rows = shape.grid_node.empty() ? count * count + 1 : 2 * shape.grid_intervals;
    if (count == 0 || rows * shape.response_stride > largest_response_table) return;
    if (shape.grid_node.empty()) {
        set_dense_responses(draft);
        set_step_responses(draft);
    } else {
        set_grid_responses(draft);
    }
    const std::vector<std::size_t>& begin = shape.certificate.group_begin;
    std::vector<double>& path = tuning.certificate.push_path;
    path.assign((begin.size() - 1) * count, 0.0);
    for (std::size_t g = 0; g + 1 < begin.size(); ++g) {
        for (std::size_t struck = 0; struck < count; ++struck) {
            double& push = path[g * count + struck];
            for (std::size_t c = begin[g]; c < begin[g + 1]; ++c)
                push = std::max(push, largest_push(draft.model, struck, c));
        }
    }
}

}  // namespace jawari
