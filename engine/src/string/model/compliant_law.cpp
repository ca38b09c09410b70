#include "string/model/compliant_law.h"

#include <limits>

#include "base/assert.h"

namespace jawari {
namespace {

/// The secant converges in five to ten rounds. Where the law is so stiff that it does not, every other round
/// halves, and the root may be a tiny part of the interval that is searched.
constexpr int most_rounds = 400;

}  // namespace

double compliant_impulse(const Compliance& law, const CompliantMoment& moment, double gap_free,
                         double compliance) {
    JAWARI_ASSERT(compliance > 0 && moment.step_s > 0);
    // In rise = compliance lambda: miss(rise) = rise - compliance h F(gap_free + rise) increases from <= 0 to
    // >= 0.
    const double factor = compliance * moment.step_s;
    const auto miss = [&](double rise) {
        return rise - factor * compliant_force(law, moment, gap_free + rise);
    };
    double low = 0;
    double miss_low = miss(low);
    if (!(miss_low < 0)) return 0;
    double high = -miss_low;
    double miss_high = miss(high);
    if (miss_high <= 0) return high / compliance;  // equal but for rounding
    int side = 0;
    bool halve = false;
    for (int round = 0; round < most_rounds; ++round) {
        const double width = high - low;
        // Illinois: an end that stays twice counts half, so that both ends move.
        double middle = (low * miss_high - high * miss_low) / (miss_high - miss_low);
        if (halve || !(middle > low && middle < high)) middle = 0.5 * (low + high);
        if (!(middle > low && middle < high)) break;
        const double found = miss(middle);
        if (found == 0) return middle / compliance;
        if (found < 0) {
            low = middle;
            miss_low = found;
            if (side < 0) miss_high /= 2;
            side = -1;
        } else {
            high = middle;
            miss_high = found;
            if (side > 0) miss_low /= 2;
            side = 1;
        }
        halve = high - low > width / 2;
        if (high - low <= 2 * std::numeric_limits<double>::epsilon() * high) break;
    }
    return 0.5 * (low + high) / compliance;
}

}  // namespace jawari
