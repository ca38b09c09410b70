// Zones of M1-100-UM v1.0.
#include "midi/mpe_zones.h"

#include <gtest/gtest.h>

namespace jawari::host {
namespace {

MpeZones zones(int lower, int upper) {
    return {lower, upper};
}

TEST(MpeZones, ChannelsOfBothZones) {
    const MpeZones split = zones(5, 3);  // channels 1 to 6 and 13 to 16, counted from 1
    for (int channel = 0; channel <= 5; ++channel) EXPECT_EQ(manager_of(split, channel), 0) << channel;
    for (int channel = 6; channel <= 11; ++channel) EXPECT_EQ(manager_of(split, channel), -1) << channel;
    for (int channel = 12; channel <= 15; ++channel) EXPECT_EQ(manager_of(split, channel), 15) << channel;
    EXPECT_FALSE(is_member(split, 0));
    EXPECT_TRUE(is_member(split, 1));
    EXPECT_FALSE(is_member(split, 8));
    EXPECT_TRUE(is_member(split, 12));
    EXPECT_FALSE(is_member(split, 15));
}

TEST(MpeZones, WithoutMembersThereIsNoZone) {
    EXPECT_EQ(manager_of(zones(0, 0), 0), -1);
    EXPECT_EQ(manager_of(zones(0, 0), 15), -1);
    EXPECT_EQ(with_zone(zones(7, 0), lower_manager, 0).lower_members, 0);
}

TEST(MpeZones, TheLatestZoneKeepsItsChannels) {
    MpeZones both = with_zone(with_zone({}, lower_manager, 7), upper_manager, 7);
    EXPECT_EQ(both.lower_members, 7);
    EXPECT_EQ(both.upper_members, 7);
    both = with_zone(both, upper_manager, 10);
    EXPECT_EQ(both.lower_members, 4);
    EXPECT_EQ(both.upper_members, 10);
    both = with_zone(both, lower_manager, 14);  // manager 16 is left without members
    EXPECT_EQ(both.lower_members, 14);
    EXPECT_EQ(both.upper_members, 0);
    both = with_zone(zones(3, 3), upper_manager, 15);
    EXPECT_EQ(both.lower_members, 0);
    EXPECT_EQ(manager_of(both, 0), 15);
}

TEST(MpeZones, EveryChannelHasOneRole) {
    for (int lower = 0; lower <= 15; ++lower) {
        for (int upper = 0; upper <= 15; ++upper) {
            const MpeZones both = with_zone(with_zone({}, lower_manager, lower), upper_manager, upper);
            const int used = (both.lower_members > 0 ? 1 + both.lower_members : 0) +
                             (both.upper_members > 0 ? 1 + both.upper_members : 0);
            EXPECT_LE(used, 16) << lower << " " << upper;
            EXPECT_EQ(both.upper_members, upper);
            int counted = 0;
            for (int channel = 0; channel < 16; ++channel) counted += manager_of(both, channel) >= 0 ? 1 : 0;
            EXPECT_EQ(counted, used);
        }
    }
}

}  // namespace
}  // namespace jawari::host
