#include "midi/guitar_mode.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace jawari::host {

namespace {

/// Index of the first string of each course, as listed.
std::vector<int> courses(const InstrumentDescription& instrument) {
    std::vector<int> firsts;
    std::set<std::size_t> seen;
    for (std::size_t i = 0; i < instrument.strings.size(); ++i) {
        const auto& course = instrument.strings[i].course;
        if (!course || seen.insert(*course).second) firsts.push_back(static_cast<int>(i));
    }
    return firsts;
}

}  // namespace

MaybeError set_guitar_mode(const InstrumentDescription& instrument, int first_channel,
                           InterpreterSettings& settings) {
    const std::vector<int> firsts = courses(instrument);
    const int channels = static_cast<int>(midi_channel_count);
    if (static_cast<int>(firsts.size()) > channels - first_channel) {
        const int highest = channels + 1 - static_cast<int>(firsts.size());
        return usage_error("--guitar-mode", std::to_string(first_channel + 1),
                           highest < 1 ? "a preset of at most 16 strings, one a channel"
                                       : "1 to " + std::to_string(highest) + " for this preset's " +
                                             std::to_string(firsts.size()) + " strings, one a channel");
    }
    settings.guitar_channel = first_channel;
    settings.guitar_strings = static_cast<int>(firsts.size());
    std::copy(firsts.rbegin(), firsts.rend(), settings.guitar_string.begin());
    return std::nullopt;
}

}  // namespace jawari::host
