#include "plugin/vst3/timed_changes.h"

#include <algorithm>
#include <tuple>

namespace jawari::host::vst3 {

void TimedChanges::add(TimedChange change) JAWARI_REALTIME {
    change.order = static_cast<std::uint32_t>(count_);
    changes_[count_++] = change;
}

std::span<const TimedChange> TimedChanges::sorted() JAWARI_REALTIME {
    const std::span<TimedChange> all(changes_.data(), count_);
    // Not std::stable_sort: it takes memory.
    std::sort(all.begin(), all.end(), [](const TimedChange& a, const TimedChange& b) {
        return std::tie(a.frame, a.order) < std::tie(b.frame, b.order);
    });
    return all;
}

}  // namespace jawari::host::vst3
