#include "string/compile/drives.h"

#include <algorithm>
#include <cstdint>

#include "string/compile/places.h"

namespace jawari {
namespace {

/// active[n] <- 1 for the frames in which a force acts.
void mark_force(const std::vector<double>& force, std::vector<std::uint8_t>& active) {
    for (std::size_t n = 0; n < force.size(); ++n) {
        const bool acts = force[n] != 0 || (n + 1 < force.size() && force[n + 1] != 0);
        if (acts) active[n] = 1;
    }
}

void mark_motion(const std::vector<double>& height, std::vector<std::uint8_t>& active) {
    for (std::size_t n = 0; n + 1 < height.size(); ++n) {
        if (height[n + 1] != height[n]) active[n] = 1;
    }
}

std::vector<std::array<std::uint64_t, 2>> spans_of(const std::vector<std::uint8_t>& active) {
    std::vector<std::array<std::uint64_t, 2>> spans;
    for (std::size_t n = 0; n < active.size(); ++n) {
        if (active[n] == 0) continue;
        if (spans.empty() || spans.back()[1] != n) spans.push_back({n, n});
        spans.back()[1] = n + 1;
    }
    return spans;
}

}  // namespace

void set_drives(StringShape& shape, const StringDescription& string) {
    Drives& drives = shape.drives;
    std::size_t frames = 0;
    for (const DrivenForce& force : string.forces) frames = std::max(frames, force.force_N.size());
    for (const DrivenHeight& motion : string.motions) frames = std::max(frames, motion.height_m.size());
    std::vector<std::uint8_t> active(frames, 0);

    drives.force_rows.assign(string.forces.size() * shape.stride, 0.0);
    for (std::size_t i = 0; i < string.forces.size(); ++i) {
        const DrivenForce& force = string.forces[i];
        write_shape(shape, string, force.position_m, force.point, 1.0,
                    drives.force_rows.data() + i * shape.stride);
        drives.force_N.push_back(force.force_N);
        mark_force(force.force_N, active);
    }
    for (const DrivenHeight& motion : string.motions) {
        drives.moved.push_back(motion.contact);
        drives.height_m.push_back(motion.height_m);
        mark_motion(motion.height_m, active);
    }
    drives.spans = spans_of(active);
}

}  // namespace jawari
