#include "run_seed.h"

#include "describe.h"
#include "instrument_run.h"
#include "live_run.h"
#include "scene_run.h"

namespace jawari::stress {

SeedKind kind_of(std::uint64_t seed) {
    if (seed % 3 != 2) return SeedKind::Scene;
    return seed % 12 == 11 ? SeedKind::Live : SeedKind::Instrument;
}

Report run_seed(const PresetShelf& shelf, std::uint64_t seed, const Budget& budget) {
    switch (kind_of(seed)) {
        case SeedKind::Instrument:
            return run_instrument(shelf, seed, budget);
        case SeedKind::Live:
            return run_live(shelf, seed, budget);
        default:
            return run_scene(seed, budget);
    }
}

std::string describe_seed(const PresetShelf& shelf, std::uint64_t seed) {
    if (kind_of(seed) == SeedKind::Scene) return describe(make_hostile_scene(seed));
    const std::string live = kind_of(seed) == SeedKind::Live ? "live, first " : "";
    return live + describe(make_hostile_instrument(shelf, seed));
}

}  // namespace jawari::stress
