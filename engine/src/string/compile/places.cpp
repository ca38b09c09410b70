#include "string/compile/places.h"

#include <algorithm>
#include <cmath>

#include "jawari/scene/modes.h"

namespace jawari {
namespace {

void add_both_sides(std::vector<ContactPlace>& places, const SpringDescription& spring,
                    const Compliance& compliance) {
    for (const Side side : {Side::Below, Side::Above}) {
        ContactDescription contact;
        contact.position_m = spring.position_m;
        contact.point = spring.point;
        contact.height_m = spring.height_m;
        contact.side = side;
        contact.compliance = compliance;
        places.push_back({contact, {}});
    }
}

}  // namespace

std::vector<ContactPlace> contact_places(const StringDescription& string) {
    std::vector<ContactPlace> places;
    for (const ContactDescription& contact : string.contacts) places.push_back({contact, {}});
    for (std::size_t i = 0; i < string.hammers.size(); ++i) {
        const FlyingHammer& hammer = string.hammers[i];
        ContactDescription contact;
        contact.position_m = hammer.position_m;
        contact.point = hammer.point;
        contact.side = hammer.side;
        contact.compliance = hammer.compliance;
        places.push_back({contact, i});
    }
    for (const SpringDescription& spring : string.springs) {
        if (spring.stiffness_N_per_m > 0) {
            Compliance elastic;
            elastic.stiffness = spring.stiffness_N_per_m;
            add_both_sides(places, spring, elastic);
        }
        if (spring.resistance_kg_per_s > 0) {
            Compliance viscous;
            viscous.resistance_kg_per_s = spring.resistance_kg_per_s;
            add_both_sides(places, spring, viscous);
        }
    }
    return places;
}

void write_shape(const StringShape& shape, const StringDescription& string, double position_m,
                 std::size_t point, double sign, double* row) {
    const std::size_t own = own_mode_count(shape);
    std::fill(row + own, row + shape.mode_count, 0.0);
    for (std::size_t k = 0; k < own; ++k) {
        row[k] = string.shapes ? sign * string.shapes->points[point][k] * shape.coordinate_unit[k]
                               : sign * mode_shape(k + 1, position_m, shape.length_m);
    }
}

double hammer_unit(const StringShape& shape, const FlyingHammer& hammer) {
    return std::sqrt(shape.linear_density_kg_per_m / hammer.mass_kg);
}

std::size_t hammer_mode(const StringShape& shape, std::size_t hammer) {
    return own_mode_count(shape) + hammer;
}

std::size_t own_mode_count(const StringShape& shape) {
    return shape.mode_count - shape.hammer_count;
}

}  // namespace jawari
