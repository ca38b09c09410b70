#include "jawari/scene/obstacles.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"

namespace jawari {
namespace {

double profile_height(std::span<const ProfilePoint> profile, double x) {
    if (x <= profile.front().first) return profile.front().second;
    for (std::size_t i = 1; i < profile.size(); ++i) {
        const auto [x0, h0] = profile[i - 1];
        const auto [x1, h1] = profile[i];
        if (x > x1) continue;
        return x1 > x0 ? h0 + (h1 - h0) * (x - x0) / (x1 - x0) : h1;
    }
    return profile.back().second;
}

}  // namespace

double equal_temperament_position(double length_m, std::size_t fret) {
    return -length_m * std::expm1(-static_cast<double>(fret) / 12 * std::log(2.0));
}

std::vector<ContactDescription> equal_temperament_frets(double length_m, std::span<const double> heights_m,
                                                        double restitution) {
    std::vector<ContactDescription> frets;
    for (const double height : heights_m) {
        frets.push_back(
            {equal_temperament_position(length_m, frets.size() + 1), height, restitution, Side::Below});
    }
    return frets;
}

std::vector<ContactDescription> sampled_neck(double length_m, std::size_t grid_points,
                                             std::span<const ProfilePoint> profile, double restitution) {
    JAWARI_ASSERT(!profile.empty());
    JAWARI_ASSERT(
        std::is_sorted(profile.begin(), profile.end(),
                       [](const ProfilePoint& a, const ProfilePoint& b) { return a.first < b.first; }));
    std::vector<ContactDescription> contacts;
    for (std::size_t j = 1; j <= grid_points; ++j) {
        const double x = length_m * static_cast<double>(j) / static_cast<double>(grid_points + 1);
        contacts.push_back({x, profile_height(profile, x), restitution, Side::Below});
    }
    return contacts;
}

}  // namespace jawari
