// A list of indices in storage of fixed capacity.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace jawari {

/// Indices (of contacts or of their groups) in the order of push(). Only allocate() allocates; the caller
/// never pushes more than the capacity. A copy into a list of the same capacity does not allocate either.
class IndexList {
  public:
    /// Makes room for `capacity` indices and empties the list.
    void allocate(std::size_t capacity) {
        storage_.assign(capacity, 0);
        size_ = 0;
    }
    void clear() noexcept { size_ = 0; }
    void push(std::size_t index) noexcept {
        assert(size_ < storage_.size());
        storage_[size_++] = static_cast<std::uint32_t>(index);
    }
    /// push(index) if `wanted`, without a branch. Needs room for the index even if it is not wanted.
    void push_if(bool wanted, std::size_t index) noexcept {
        assert(size_ < storage_.size());
        storage_[size_] = static_cast<std::uint32_t>(index);
        size_ += wanted ? 1 : 0;
    }
    /// The list becomes 0, 1, ..., count - 1.
    void fill_to(std::size_t count) noexcept {
        clear();
        for (std::size_t i = 0; i < count; ++i) push(i);
    }
    /// Removes the first occurrence of `index`, if there is one; the order of the others stays.
    void remove(std::uint32_t index) noexcept {
        bool found = false;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            if (!found && storage_[i] == index) {
                found = true;
            } else {
                storage_[kept++] = storage_[i];
            }
        }
        size_ = kept;
    }
    /// Keeps the indices for which keep(index) is true, in their order.
    template <class Keep>
    void filter(const Keep& keep) noexcept {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            const std::uint32_t index = storage_[i];  // before kept <= i is written
            if (keep(index)) storage_[kept++] = index;
        }
        size_ = kept;
    }

    std::size_t size() const noexcept { return size_; }
    std::size_t capacity() const noexcept { return storage_.size(); }
    bool empty() const noexcept { return size_ == 0; }
    std::uint32_t operator[](std::size_t i) const noexcept { return storage_[i]; }
    const std::uint32_t* data() const noexcept { return storage_.data(); }
    const std::uint32_t* begin() const noexcept { return data(); }
    const std::uint32_t* end() const noexcept { return data() + size_; }
    std::span<const std::uint32_t> span() const noexcept { return {data(), size_}; }

  private:
    std::vector<std::uint32_t> storage_;
    std::size_t size_ = 0;
};

}  // namespace jawari
