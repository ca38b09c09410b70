#include "string/compile/compile_frames.h"

#include <algorithm>
#include <cmath>

#include "base/square.h"
#include "jawari/detail/step_coefficients.h"
#include "string/broad_phase/gap_bounds.h"
#include "string/compile/contact_tables.h"
#include "string/frame/short_frame.h"
#include "string/kernels/mode_sums.h"

namespace jawari {
namespace {

/// Contacts per group of a string with more than contacts_with_own_bounds.
constexpr std::size_t contacts_per_group = 16;

/// d = 0 and s = 0 are possible (undamped modes at multiples of the step's Nyquist rate): their bounds become
/// huge, not infinite, and what they bound is then simply evaluated.
constexpr double smallest_factor = 1e-100;

void set_flight(StringDraft& draft) {
    StringShape& shape = *draft.shape;
    StringTuning& tuning = draft.model.tuning;
    FlightModel& flight = tuning.flight;
    for (auto* array : {&flight.qq, &flight.qv, &flight.vq, &flight.vv, &flight.q_held, &flight.v_held,
                        &flight.q_ramp, &flight.v_ramp}) {
        array->assign(shape.stride, 0.0);
    }
    const double mu = shape.linear_density_kg_per_m;
    for (std::size_t k = 0; k < shape.mode_count; ++k) {
        const FlightFactors f =
            flight_factors(tuning.omega[k], shape.sigma[k], shape.step_s, shape.steps_per_frame);
        flight.qq[k] = f.qq;
        flight.qv[k] = f.qv;
        flight.vq[k] = f.vq;
        flight.vv[k] = f.vv;
        flight.q_held[k] = f.q_held / mu;
        flight.v_held[k] = f.v_held / mu;
        flight.q_ramp[k] = f.q_ramp / mu;
        flight.v_ramp[k] = f.v_ramp / mu;
    }
}

/// docs/engine/certificate.md, sections 1 and 2.
void set_bounds_of_modes(StringDraft& draft) {
    StringShape& shape = *draft.shape;
    StringTuning& tuning = draft.model.tuning;
    CertificateTuning& certificate = tuning.certificate;
    for (auto* array :
         {&certificate.stiffness, &certificate.extent, &certificate.detour, &certificate.kick}) {
        array->assign(shape.stride, 0.0);
    }
    const double h = shape.step_s;
    const double frame_s = h * static_cast<double>(shape.steps_per_frame);
    for (std::size_t k = 0; k < shape.mode_count; ++k) {
        const ExactFactors step = exact_factors(tuning.omega[k], shape.sigma[k], h);
        const double s = std::max(step.s, smallest_factor);
        const double d = std::max(step.d, smallest_factor);
        const double lost = -std::expm1(-2 * shape.sigma[k] * h);                            // 1 - e
        const double acceleration = (lost + std::sqrt(square(lost + d) + d * s)) / (2 * h);  // times r
        certificate.stiffness[k] = 4 * d / (s * square(h));
        certificate.extent[k] = h * std::sqrt((1 + step.e) / (2 * d));
        certificate.detour[k] = std::min(square(frame_s) / 8 * acceleration, 2 * certificate.extent[k]);
        certificate.kick[k] = std::sqrt(2 * (1 + step.e) / s) * shape.mobility[k];
    }
}

/// docs/engine/certificate.md, section 7.
void set_reach(StringDraft& draft) {
    StringShape& shape = *draft.shape;
    StringTuning& tuning = draft.model.tuning;
    CertificateTuning& certificate = tuning.certificate;
    double kicks = 0;
    for (std::size_t k = 0; k < shape.mode_count; ++k) kicks += certificate.kick[k];
    const double frame_s = shape.step_s * static_cast<double>(shape.steps_per_frame);
    certificate.force_reach = bound_safety * (2 / shape.length_m) * square(frame_s) / 8 * kicks;
    std::vector<double>& reach = shape.certificate.reach;
    // Energy does not bound how far a mode goes that nothing holds.
    const auto modes_end = tuning.omega.begin() + static_cast<std::ptrdiff_t>(shape.mode_count);
    if (std::find(tuning.omega.begin(), modes_end, 0.0) != modes_end) return;
    reach.assign(shape.contact_count, 0.0);
    for (std::size_t c = 0; c < shape.contact_count; ++c) {
        const double* row = shape.contact_rows.data() + c * shape.stride;
        double of_ends = 0;
        double of_detours = 0;
        for (std::size_t k = 0; k < shape.mode_count; ++k) {
            // r^2 = stiffness/potential H
            const double weight = square(row[k]) * certificate.stiffness[k] / tuning.potential[k];
            of_ends += weight * square(certificate.extent[k]);
            of_detours += weight * square(certificate.detour[k]);
        }
        reach[c] = bound_safety * (std::sqrt(of_ends) + std::sqrt(of_detours));
    }
}

void set_groups(StringShape& shape) {
    CertificateShape& certificate = shape.certificate;
    const std::size_t size = shape.contact_count <= contacts_with_own_bounds ? 1 : contacts_per_group;
    for (std::size_t c = 0; c < shape.contact_count; c += size) certificate.group_begin.push_back(c);
    const std::size_t groups = certificate.group_begin.size();
    certificate.group_begin.push_back(shape.contact_count);
    certificate.envelope.assign(groups * shape.stride, 0.0);
    for (std::size_t g = 0; g < groups; ++g) {
        double* envelope = certificate.envelope.data() + g * shape.stride;
        for (std::size_t c = certificate.group_begin[g]; c < certificate.group_begin[g + 1]; ++c) {
            const double* row = shape.contact_rows.data() + c * shape.stride;
            for (std::size_t k = 0; k < shape.mode_count; ++k)
                envelope[k] = std::max(envelope[k], std::abs(row[k]));
        }
    }
}

/// push_speed[c][g] = sum_k envelope_g kick |S_c|
void set_push_speeds(StringDraft& draft) {
    StringShape& shape = *draft.shape;
    CertificateShape& certificate = shape.certificate;
    const AlignedVector<double>& kick_of_mode = draft.model.tuning.certificate.kick;
    const std::size_t groups = certificate.group_begin.size() - 1;
    certificate.push_speed.assign(shape.contact_count * groups, 0.0);
    AlignedVector<double> kick(shape.stride);
    for (std::size_t c = 0; c < shape.contact_count; ++c) {
        const double* row = shape.contact_rows.data() + c * shape.stride;
        for (std::size_t k = 0; k < shape.stride; ++k) kick[k] = kick_of_mode[k] * std::abs(row[k]);
        kernels::row_products(groups, shape.stride, shape.stride, certificate.envelope.data(), kick.data(),
                              certificate.push_speed.data() + c * groups);
    }
}

}  // namespace

void set_skipping(StringDraft& draft) {
    set_flight(draft);
    set_bounds_of_modes(draft);
    set_groups(*draft.shape);
    set_push_speeds(draft);
    set_reach(draft);
    // Frames with compliant contacts are stepped: the tables serve the solvers of rigid ones.
    if (!draft.shape->contact_compliance.empty()) return;
    set_responses(draft);
    draft.shape->contact_columns = columns_for_short_frames(draft.model);
}

}  // namespace jawari
