#include "jawari/scene/counters.h"

#include <algorithm>

namespace jawari {

Counters& operator+=(Counters& sum, const Counters& more) JAWARI_REALTIME {
    sum.steps += more.steps;
    sum.candidates += more.candidates;
    sum.impulses += more.impulses;
    sum.solves += more.solves;
    sum.truncated_solves += more.truncated_solves;
    sum.flown_frames += more.flown_frames;
    sum.near_frames += more.near_frames;
    sum.asleep_frames += more.asleep_frames;
    sum.nonfinite_resets += more.nonfinite_resets;
    sum.worst_residual_m = std::max(sum.worst_residual_m, more.worst_residual_m);
    sum.worst_penetration_m = std::max(sum.worst_penetration_m, more.worst_penetration_m);
    return sum;
}

}  // namespace jawari
