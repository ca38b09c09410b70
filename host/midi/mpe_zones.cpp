#include "midi/mpe_zones.h"

#include <algorithm>

namespace jawari::host {

namespace {

constexpr int channels = 16;

/// Members that are left to the other zone: its manager must be outside this one.
int members_beside(int members, int other) {
    return std::min(other, std::max(0, channels - 2 - members));
}

}  // namespace

MpeZones with_zone(MpeZones zones, int manager, int members) JAWARI_REALTIME {
    int& own = manager == lower_manager ? zones.lower_members : zones.upper_members;
    int& other = manager == lower_manager ? zones.upper_members : zones.lower_members;
    own = std::clamp(members, 0, channels - 1);
    if (own > 0) other = members_beside(own, other);
    return zones;
}

int manager_of(const MpeZones& zones, int channel) JAWARI_REALTIME {
    if (zones.lower_members > 0 && channel <= zones.lower_members) return lower_manager;
    if (zones.upper_members > 0 && channel >= upper_manager - zones.upper_members) return upper_manager;
    return -1;
}

bool is_member(const MpeZones& zones, int channel) JAWARI_REALTIME {
    const int manager = manager_of(zones, channel);
    return manager >= 0 && manager != channel;
}

}  // namespace jawari::host
