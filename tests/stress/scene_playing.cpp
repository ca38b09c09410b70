#include "scene_playing.h"

#include <algorithm>
#include <cmath>

#include "jawari/scene/render.h"
#include "reach.h"
#include "string/state/excitation.h"

namespace jawari::stress {
namespace {

/// Multiply-adds of the dearest block.
constexpr double work_of_block = 4e7;

void apply_force(const ForceAction& force, const StringModel& model, double height_m, std::size_t frames,
                 StringState& state) {
    const AlignedVector<double> row = shape_row(model, force.place * model.shape->length_m);
    const double compliance = std::pow(reach_of(model, row).middle, 2) / 2;  // u/F at rest [m/N]
    if (!(compliance > 0) || !std::isfinite(1 / compliance)) return;
    const double newtons_per_lift = height_m / compliance;
    const double steps = static_cast<double>(frames * model.shape->steps_per_frame);
    // Forces that ramp must be set together: one that ramps stands alone.
    if (force.instead || force.growth != 0 || state.excitation.ramps) clear_excitation(state);
    add_force(state, row.data(), model.shape->stride, force.lift * newtons_per_lift,
              force.growth * newtons_per_lift / steps);
}

}  // namespace

ScenePlaying::ScenePlaying(const HostileScene& hostile, const SceneModel& model, std::uint64_t seed)
    : dice_(seed ^ 0xA5A5F00DBEEF1234ULL),
      strings_(model.strings.size()),
      steps_per_frame_(model.steps_per_frame),
      forces_(hostile.forces),
      moves_(hostile.moves),
      ramps_(hostile.metering == Metering::Step) {
    double work = 0;
    for (const StringModel& string : model.strings)
        work += static_cast<double>((string.shape->mode_count + 8) * (string.shape->contact_count + 6));
    work *= static_cast<double>(model.steps_per_frame);
    most_frames_ = static_cast<std::size_t>(std::clamp(work_of_block / work, 1.0, 512.0));
}

PlayedBlock ScenePlaying::next() {
    PlayedBlock block;
    block.frames = dice_.spread_whole(1, most_frames_);
    if (forces_ && dice_.chance(0.4)) {
        block.release = dice_.chance(0.3);
        for (std::size_t n = block.release ? 0 : dice_.whole(1, 3); n > 0; --n) {
            ForceAction force;
            force.string = dice_.whole(0, strings_ - 1);
            force.place = dice_.uniform(0.001, 0.999);
            force.lift = dice_.uniform(-10, 10);
            force.growth = ramps_ && dice_.chance(0.3) ? dice_.uniform(-10, 10) : 0.0;
            force.instead = dice_.chance(0.6);
            block.forces.push_back(force);
        }
    }
    if (moves_ && dice_.chance(0.5)) {
        for (std::size_t n = dice_.whole(1, 3); n > 0; --n) {
            MoveAction move;
            move.string = dice_.whole(0, strings_ - 1);
            move.contact = dice_.bits();
            move.height = dice_.uniform(-10, dice_.chance(0.3) ? 3 : 0);
            move.steps = dice_.chance(0.2) ? 1 : dice_.spread_whole(1, 100 * steps_per_frame_);
            block.moves.push_back(move);
        }
    }
    return block;
}

void act(const PlayedBlock& block, const SceneModel& model, double height_m, SceneState& state) {
    if (block.release) {
        for (StringState& string : state.strings) clear_excitation(string);
    }
    for (const ForceAction& force : block.forces)
        apply_force(force, model.strings[force.string], height_m, block.frames, state.strings[force.string]);
    for (const MoveAction& move : block.moves) {
        const StringModel& string = model.strings[move.string];
        if (string.shape->contact_of_description.empty()) continue;
        const std::size_t contact = move.contact % string.shape->contact_of_description.size();
        const std::ptrdiff_t kept = string.shape->contact_of_description[contact];
        if (kept < 0) continue;
        const Side side = string.shape->contact_side[static_cast<std::size_t>(kept)];
        const double sign = side == Side::Below ? 1.0 : -1.0;
        move_contact(string, state.strings[move.string], contact, sign * move.height * height_m, move.steps);
    }
}

}  // namespace jawari::stress
