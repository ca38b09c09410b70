// A range of consecutive indices for range-based loops.
#pragma once

#include <cstddef>

namespace jawari {

/// first, first + 1, ..., last - 1: std::views::iota, which clang 14 cannot compile with libstdc++.
struct IndexRange {
    struct Iterator {
        std::size_t index;
        std::size_t operator*() const noexcept { return index; }
        Iterator& operator++() noexcept {
            ++index;
            return *this;
        }
        bool operator!=(const Iterator& other) const noexcept { return index != other.index; }
    };

    std::size_t first = 0;
    std::size_t last = 0;

    Iterator begin() const noexcept { return {first}; }
    Iterator end() const noexcept { return {last}; }
};

}  // namespace jawari
