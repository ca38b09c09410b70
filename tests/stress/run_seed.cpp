#include "run_seed.h"

#include "instrument_run.h"
#include "scene_run.h"

namespace jawari::stress {

Report run_seed(const PresetShelf& shelf, std::uint64_t seed, const Budget& budget) {
    return seed % 3 == 2 ? run_instrument(shelf, seed, budget) : run_scene(seed, budget);
}

}  // namespace jawari::stress
