#include "string/frame/drive.h"

#include <algorithm>
#include <limits>

#include "jawari/scene/render.h"
#include "string/state/excitation.h"

namespace jawari {
namespace {

/// The first span that ends after the frame, or the end of all.
auto span_at(const Drives& drives, std::uint64_t frame) {
    return std::upper_bound(drives.spans.begin(), drives.spans.end(), frame,
                            [](std::uint64_t at, const auto& span) { return at < span[1]; });
}

void set_forces(const StringModel& model, StringState& state) {
    const StringShape& shape = *model.shape;
    const Drives& drives = shape.drives;
    clear_excitation(state);
    for (std::size_t i = 0; i < drives.force_N.size(); ++i) {
        const std::vector<double>& force = drives.force_N[i];
        const auto at = [&](std::uint64_t frame) { return frame < force.size() ? force[frame] : 0.0; };
        const double now = at(state.frame);
        const double next = at(state.frame + 1);
        if (now == 0 && next == 0) continue;
        add_force(state, drives.force_rows.data() + i * shape.stride, shape.stride, now,
                  (next - now) / static_cast<double>(shape.steps_per_frame));
    }
}

void start_movements(const StringModel& model, StringState& state) {
    const Drives& drives = model.shape->drives;
    const std::uint64_t next = state.frame + 1;
    for (std::size_t i = 0; i < drives.moved.size(); ++i) {
        const std::vector<double>& height = drives.height_m[i];
        if (next >= height.size() || height[next] == height[next - 1]) continue;
        move_contact(model, state, drives.moved[i], height[next], model.shape->steps_per_frame);
    }
}

}  // namespace

void drive_frame(const StringModel& model, StringState& state) JAWARI_REALTIME {
    const Drives& drives = model.shape->drives;
    if (drives.spans.empty()) return;
    const auto span = span_at(drives, state.frame);
    if (span != drives.spans.end() && (*span)[0] <= state.frame) {
        set_forces(model, state);
        start_movements(model, state);
    } else if (!drives.force_N.empty() && is_excited(state)) {
        clear_excitation(state);
    }
}

std::uint64_t undriven_frames(const StringModel& model, const StringState& state) JAWARI_REALTIME {
    const Drives& drives = model.shape->drives;
    const auto span = span_at(drives, state.frame);
    if (span == drives.spans.end()) return std::numeric_limits<std::uint64_t>::max();
    return (*span)[0] > state.frame ? (*span)[0] - state.frame : 0;
}

}  // namespace jawari
