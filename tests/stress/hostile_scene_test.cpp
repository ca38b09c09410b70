// What the generator promises: the whole box, each seed for good.
#include "hostile_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "describe.h"
#include "dice.h"

namespace jawari::stress {
namespace {

TEST(Dice, FollowThePublishedGenerator) {
    Dice dice(0);  // first outputs of SplitMix64 from seed 0
    EXPECT_EQ(dice.bits(), 0xE220A8397B1DCDAFULL);
    EXPECT_EQ(dice.bits(), 0x6E789E6AA1B965F4ULL);
    EXPECT_EQ(dice.bits(), 0x06C45D188009454FULL);
}

TEST(HostileScene, IsTheSameForTheSameSeed) {
    for (std::uint64_t seed = 0; seed < 50; ++seed)
        EXPECT_EQ(describe(make_hostile_scene(seed)), describe(make_hostile_scene(seed)));
    EXPECT_NE(describe(make_hostile_scene(1)), describe(make_hostile_scene(2)));
}

struct Extent {
    double low = 1e300, high = -1e300;
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

TEST(HostileScene, ReachesTheCornersOfTheBox) {
    Extent output_rate, contact_rate, contacts, restitution, length, density, pluck;
    std::set<ImpactLaw> laws;
    std::size_t above_rest = 0, coincident = 0, at_ends = 0, moves = 0, forces = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        const HostileScene hostile = make_hostile_scene(seed);
        const SceneDescription& scene = hostile.description;
        output_rate.add(scene.output_rate_hz);
        contact_rate.add(scene.contact_rate_hz);
        laws.insert(scene.law);
        moves += hostile.moves;
        forces += hostile.forces;
        for (const StringDescription& string : scene.strings) {
            contacts.add(static_cast<double>(string.contacts.size()));
            length.add(string.length_m);
            density.add(string.linear_density_kg_per_m);
            std::set<double> places;
            for (const ContactDescription& contact : string.contacts) {
                restitution.add(contact.restitution);
                above_rest += contact.side == Side::Below && contact.height_m > 0;
                at_ends += contact.position_m == 0 || contact.position_m == string.length_m;
                coincident += !places.insert(contact.position_m).second;
            }
            if (const auto* shape = std::get_if<Pluck>(&string.initial.shape))
                pluck.add(shape->height_m / hostile.height_m);
        }
    }
    EXPECT_EQ(output_rate.low, 8000);
    EXPECT_EQ(output_rate.high, 768000);
    EXPECT_GT(contact_rate.high, 63e6);
    EXPECT_EQ(contacts.low, 0);
    EXPECT_GT(contacts.high, 4000);
    EXPECT_EQ(restitution.low, 0);
    EXPECT_EQ(restitution.high, 1);
    EXPECT_LT(length.low, 0.002);
    EXPECT_GT(length.high, 500);
    EXPECT_LT(density.low, 1e-8);
    EXPECT_GT(density.high, 1e6);
    EXPECT_GT(pluck.high, 9.9);
    EXPECT_EQ(laws.size(), 4U);
    for (const std::size_t count : {above_rest, coincident, at_ends, moves, forces}) EXPECT_GT(count, 100U);
}

}  // namespace
}  // namespace jawari::stress
