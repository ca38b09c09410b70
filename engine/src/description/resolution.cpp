#include "jawari/scene/resolution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "jawari/scene/modes.h"

namespace jawari {
namespace {

/// Error of the contact law times the contact rate: the largest over rates from 96 kHz to 8 MHz [Hz].
constexpr double error_times_rate_hz = 0.0095e6;
/// First mode of the string that it was measured on.
constexpr double bass_fundamental_hz = 97.97;

struct ModeError {
    double limit_hz;
    double error;  ///< left when the modes above the limit are missing
};
constexpr std::array<ModeError, 7> mode_errors{
    {{8e3, 0.49}, {12e3, 0.35}, {16e3, 0.34}, {20e3, 0.23}, {30e3, 0.07}, {42e3, 0.056}, {60e3, 0.047}}};
/// The published bass has modes up to here.
constexpr ModeError all_modes{std::numeric_limits<double>::infinity(), 0};
/// Missing modes may use up this share of the error.
constexpr double share_of_modes = 0.95;

ModeError fewest_modes(double error) {
    for (const ModeError& candidate : mode_errors) {
        if (candidate.error <= share_of_modes * error) return candidate;
    }
    return all_modes;
}

std::size_t modes_up_to(const StringDescription& string, double limit_hz) {
    const Modes modes = modes_of(string);
    const auto below = [&](double omega) { return omega <= 2 * std::numbers::pi * limit_hz; };
    const auto count = std::find_if_not(modes.omega.begin(), modes.omega.end(), below) - modes.omega.begin();
    return std::max<std::size_t>(static_cast<std::size_t>(count), 1);
}

}  // namespace

const char* name_of(Quality quality) {
    switch (quality) {
        case Quality::Live:
            return "live";
        case Quality::Studio:
            return "studio";
        case Quality::Reference:
            return "reference";
    }
    return "";
}

double error_target(Quality quality) {
    switch (quality) {
        case Quality::Live:
            return 0.2;
        case Quality::Studio:
            return 0.01;
        case Quality::Reference:
            return 0.001;
    }
    return 0;
}

Resolution resolution_for(double error, double output_rate_hz) {
    const ModeError modes = fewest_modes(error);
    const double of_contact = std::sqrt(error * error - modes.error * modes.error);
    const double steps = std::ceil(error_times_rate_hz / of_contact / output_rate_hz);
    return {steps * output_rate_hz, modes.limit_hz};
}

void keep_modes(StringDescription& string, std::size_t count) {
    for (const ProbeDescription& probe : string.probes) count = std::max(count, probe.mode);
    const auto cut = [count](std::vector<double>& values) { values.resize(std::min(count, values.size())); };
    if (auto* physical = std::get_if<PhysicalModes>(&string.modes)) {
        physical->count = std::min(count, physical->count);
    } else if (auto* table = std::get_if<ModeTable>(&string.modes)) {
        cut(table->frequency_hz);
        cut(table->decay_per_s);
    }
    if (string.shapes) {
        cut(string.shapes->modal_mass_kg);
        for (std::vector<double>& point : string.shapes->points) cut(point);
    }
    if (auto* state = std::get_if<ModalState>(&string.initial.shape)) {
        cut(state->displacement);
        cut(state->velocity);
    }
}

double contact_error(double fundamental_hz, double contact_rate_hz) {
    return error_times_rate_hz * (fundamental_hz / bass_fundamental_hz) / contact_rate_hz;
}

SceneDescription at_quality(SceneDescription scene, Quality quality) {
    const Resolution resolution = resolution_for(error_target(quality), scene.output_rate_hz);
    scene.contact_rate_hz = resolution.contact_rate_hz;
    for (StringDescription& string : scene.strings)
        keep_modes(string, modes_up_to(string, resolution.mode_limit_hz));
    return scene;
}

}  // namespace jawari
