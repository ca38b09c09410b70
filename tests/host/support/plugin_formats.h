// What the plugin's hosts of the tests have in common.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

namespace jawari::test {

/// `frames` frames in blocks of `block`; the last may be shorter.
template <class Instance>
void render_in_blocks(Instance& instance, std::size_t frames, std::uint32_t block) {
    for (std::size_t done = 0; done < frames;) {
        const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(block, frames - done));
        instance.process(count);
        done += count;
    }
}

/// Names of typed suites over formats.
struct FormatNames {
    template <class Instance>
    static std::string GetName(int /*index*/) {
        std::string name = Instance::format;
        std::erase(name, ' ');
        return name;
    }
};

}  // namespace jawari::test
