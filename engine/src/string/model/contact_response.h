// What an impulse at one contact does to the gaps of all contacts, read from the model's tables: at once (the
// Delassus operator) and within a frame.
#pragma once

#include <cstddef>

#include "jawari/detail/lcp.h"
#include "jawari/detail/string_model.h"

namespace jawari {

/// A = h theta D
inline ContactOperator compliance_of(const StringShape& shape) {
    ContactOperator A;
    A.values = shape.compliance.data();
    A.stride = shape.contact_stride;
    A.node = shape.grid_node.empty() ? nullptr : shape.grid_node.data();
    A.id = shape.compliance_id;
    A.period = 2 * shape.grid_intervals;
    A.norm = shape.compliance_norm;
    return A;
}

inline ContactOperator compliance_of(const StringModel& model) {
    return compliance_of(*model.shape);
}

/// Gap rate of a contact n steps after 1 N s at the struck one: direct[n] - mirrored[n] [1/kg].
struct Response {
    const double* direct;
    const double* mirrored;
};

inline Response response_of(const StringModel& model, std::size_t struck, std::size_t contact) {
    const double* table = model.tuning.response.data();
    const std::size_t stride = model.shape->response_stride;
    if (model.shape->grid_node.empty()) {
        const std::size_t nothing =
            model.shape->contact_count * model.shape->contact_count;  // the last row is zero
        return {table + (struck * model.shape->contact_count + contact) * stride, table + nothing * stride};
    }
    const auto [apart, together] =
        grid_distances(model.shape->grid_node[struck], model.shape->grid_node[contact]);
    return {table + apart * stride, table + together * stride};
}

}  // namespace jawari
