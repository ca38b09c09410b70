// Strings at the edges of the parameter box: modes, losses, obstacles, initial states.
#pragma once

#include "dice.h"
#include "jawari/scene/description.h"

namespace jawari::stress {

/// How much a scene may cost: work in a frame and in compile() is bounded so that a scene takes about 0.1 s.
struct SizeLimits {
    std::size_t contacts = 0;
    std::size_t modes = 0;
};

struct StringPlan {
    SizeLimits sizes;
    bool extreme = false;  ///< tension, density, length and obstacles over 16 decades and more
    bool tabled = false;   ///< modes from a table, resonances of the step among them
    bool neck = false;     ///< contacts on a uniform grid
    bool lifted = false;   ///< obstacles above the string at rest
    double contact_rate_hz = 0;
};

struct PlannedString {
    StringDescription string;
    double height_m = 0;  ///< typical height of its obstacles
};

PlannedString make_string(const StringPlan& plan, Dice& dice);

}  // namespace jawari::stress
