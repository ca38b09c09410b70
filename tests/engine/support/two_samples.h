// Whether the values of one sample tend to be larger than those of another: the one-sided two-sample test of
// Kolmogorov and Smirnov, exact for samples of one size, whatever the distribution.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace jawari::test {

/// Probability that, of 2n draws from one distribution in random order, the first n seem to be larger by
/// `lead` / n or more (below): binomial(2n, n - lead) / binomial(2n, n), by the reflection of paths. Draws
/// that are equal make it smaller.
inline double chance_of_lead(std::size_t n, std::size_t lead) {
    double ratio = 1;
    for (std::size_t i = 0; i < lead; ++i)
        ratio *= static_cast<double>(n - i) / static_cast<double>(n + i + 1);
    return ratio;
}

/// Most that the count of `b` up to some value is ahead of the count of `a`: n if all of `a` are larger than
/// all of `b`. Both have one size.
inline std::size_t lead_of_larger(std::vector<double> a, std::vector<double> b) {
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    std::size_t lead = 0;
    for (std::size_t of_b = 1, of_a = 0; of_b <= b.size(); ++of_b) {
        while (of_a < a.size() && a[of_a] <= b[of_b - 1]) ++of_a;
        if (of_b > of_a) lead = std::max(lead, of_b - of_a);
    }
    return lead;
}

/// Whether `a` is larger than `b`, in the sense that equal distributions show so much with less than this
/// chance.
inline bool is_larger(const std::vector<double>& a, const std::vector<double>& b, double chance) {
    const std::size_t lead = lead_of_larger(a, b);
    return lead > 0 && chance_of_lead(a.size(), lead) < chance;
}

}  // namespace jawari::test
