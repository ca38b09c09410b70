// The channels of MIDI Polyphonic Expression ("MIDI Polyphonic Expression", M1-100-UM v1.0, 2018).
#pragma once

#include "jawari/realtime.h"

namespace jawari::host {

/// The lower zone's manager is channel 0, its members 1, 2, ...; the upper zone's manager is channel 15, its
/// members 14, 13, ... Channels count from 0. A zone without members does not exist.
struct MpeZones {
    int lower_members = 0;  ///< 0 to 15
    int upper_members = 0;  ///< 0 to 15
};

inline constexpr int lower_manager = 0;
inline constexpr int upper_manager = 15;

/// The MPE configuration message on a manager channel. The zone of the latest message keeps its channels: the
/// other one shrinks, and ends when no member is left to it.
MpeZones with_zone(MpeZones zones, int manager, int members) JAWARI_REALTIME;

/// Manager of the zone that the channel belongs to, as a member or as its manager; -1: no zone.
int manager_of(const MpeZones& zones, int channel) JAWARI_REALTIME;

/// Whether the channel carries single notes of a zone.
bool is_member(const MpeZones& zones, int channel) JAWARI_REALTIME;

}  // namespace jawari::host
