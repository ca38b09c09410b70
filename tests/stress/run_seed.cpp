#include "run_seed.h"

#include "describe.h"
#include "instrument_run.h"
#include "scene_run.h"

namespace jawari::stress {

bool plays_instrument(std::uint64_t seed) {
    return seed % 3 == 2;
}

Report run_seed(const PresetShelf& shelf, std::uint64_t seed, const Budget& budget) {
    return plays_instrument(seed) ? run_instrument(shelf, seed, budget) : run_scene(seed, budget);
}

std::string describe_seed(const PresetShelf& shelf, std::uint64_t seed) {
    return plays_instrument(seed) ? describe(make_hostile_instrument(shelf, seed))
                                  : describe(make_hostile_scene(seed));
}

}  // namespace jawari::stress
