// What an impulse at one contact does to the gaps of all contacts: at once (the Delassus operator) and within
// a frame.
#pragma once

#include <cstddef>

#include "jawari/lcp.h"
#include "jawari/model.h"

namespace jawari {

/// Largest table of responses in time [doubles]; models that would need a larger one step their near frames
/// instead.
inline constexpr std::size_t largest_response_table = std::size_t{1} << 22;

/// Frames of at most so many steps have few impulses per contact, so that spreading them over the contacts is
/// cheaper than over time.
inline constexpr std::size_t longest_step_response = 16;

/// Finds out whether the contacts lie on a uniform grid, then fills model.compliance.
void set_compliance(StringModel& model);

/// Fills model.response, if it is not too large, and what impulses can push other contacts within a frame.
/// Exact scheme only; needs the compliance and the groups of the certificate.
void set_responses(StringModel& model);

/// A = h theta D
inline ContactOperator compliance_of(const StringModel& model) {
    return {model.compliance.data(), model.contact_stride,
            model.grid_node.empty() ? nullptr : model.grid_node.data()};
}

/// Gap rate of a contact n steps after 1 N s at the struck one: direct[n] - mirrored[n] [1/kg].
struct Response {
    const double* direct;
    const double* mirrored;
};

inline Response response_of(const StringModel& model, std::size_t struck, std::size_t contact) {
    const double* table = model.response.data();
    const std::size_t stride = model.response_stride;
    if (model.grid_node.empty()) {
        const std::size_t nothing = model.contact_count * model.contact_count;  // the last row is zero
        return {table + (struck * model.contact_count + contact) * stride, table + nothing * stride};
    }
    const auto [apart, together] = grid_distances(model.grid_node[struck], model.grid_node[contact]);
    return {table + apart * stride, table + together * stride};
}

}  // namespace jawari
