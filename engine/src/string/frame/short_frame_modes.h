// The modes of a short frame, with the rates of all gaps at each step.
#pragma once

#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"

namespace jawari::kernels {

/// short_frame.rates <- S v of free flight (and of the excitation) at each step, for all contacts;
/// displacement_flown, velocity_flown <- the frame's end. Returns false if that is not finite.
bool run_freely(const StringModel& model, StringState& state) noexcept;

/// short_frame.step_response <- the rows of the contact, for a model without a table of them: rates of all
/// gaps in the steps after an impulse of 1 N s.
void find_response(const StringModel& model, StringState& state, std::size_t struck) noexcept;

/// displacement_flown, velocity_flown += the response of all modes to short_frame.impulses of the contacts
/// struck. Returns false if the sum is not finite.
bool add_response(const StringModel& model, StringState& state) noexcept;

}  // namespace jawari::kernels
