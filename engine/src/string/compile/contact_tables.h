// Builds a model's contact tables: the Delassus operator and what an impulse does within a frame.
#pragma once

#include <cstddef>

#include "jawari/detail/aligned.h"
#include "string/compile/string_draft.h"

namespace jawari {

/// Largest table of responses in time [doubles]; models that would need a larger one step their near frames
/// instead.
inline constexpr std::size_t largest_response_table = std::size_t{1} << 22;

/// Frames of at most so many steps have few impulses per contact, so that spreading them over the contacts is
/// cheaper than over time.
inline constexpr std::size_t longest_step_response = 16;

/// Finds out whether the contacts lie on a uniform grid, then fills the compliance.
void set_compliance(StringShape& shape);

/// S diag(scale weights) S^T over the contacts, a matrix or a table by grid distance as the compliance is;
/// needs set_compliance().
AlignedVector<double> contact_operator(const StringShape& shape, double scale,
                                       const AlignedVector<double>& weights);

/// Fills the responses, if they are not too large, and with them how far impulses push other contacts within
/// a frame.
/// Exact scheme only; needs the compliance and the groups of the certificate.
void set_responses(StringDraft& draft);

}  // namespace jawari
