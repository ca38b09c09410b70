// Builds a model's contact tables: the Delassus operator and what an impulse does within a frame.
#pragma once

#include <cstddef>

#include "jawari/detail/string_model.h"

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

}  // namespace jawari
