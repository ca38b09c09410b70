// Hostile playing of a scene: blocks of random length, forces switched and obstacles moved between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dice.h"
#include "hostile_scene.h"
#include "jawari/detail/string_model.h"
#include "jawari/detail/string_state.h"

namespace jawari::stress {

struct ForceAction {
    std::size_t string = 0;
    double place = 0;     ///< share of the length
    double lift = 0;      ///< of the string at rest by the force, in heights of its obstacles
    double growth = 0;    ///< lifts that the force grows by in the block
    bool instead = true;  ///< of the forces before; else beside them
};

struct MoveAction {
    std::size_t string = 0;
    std::uint64_t contact = 0;  ///< modulo the contacts kept
    double height = 0;          ///< in heights of obstacles
    std::uint64_t steps = 1;
};

struct PlayedBlock {
    std::size_t frames = 1;
    bool release = false;  ///< all forces end
    std::vector<ForceAction> forces;
    std::vector<MoveAction> moves;

    [[nodiscard]] bool acts() const { return release || !forces.empty() || !moves.empty(); }
};

/// The blocks of a scene, one after another: the same for the same seed.
class ScenePlaying {
  public:
    ScenePlaying(const HostileScene& hostile, const SceneModel& model, std::uint64_t seed);
    PlayedBlock next();

  private:
    Dice dice_;
    std::size_t strings_ = 0;
    std::size_t most_frames_ = 1;
    std::uint64_t steps_per_frame_ = 1;
    bool forces_ = false, moves_ = false, ramps_ = false;
};

/// Does to the state what the block begins with.
void act(const PlayedBlock& block, const SceneModel& model, double height_m, SceneState& state);

}  // namespace jawari::stress
