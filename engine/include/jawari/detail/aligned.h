// Vectors whose storage is aligned to a cache line and a full SIMD register.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace jawari {

/// Alignment of the storage [bytes]: a cache line, and the widest SIMD register.
inline constexpr std::size_t vector_alignment = 64;
/// Mode counts are padded to a multiple of this many doubles with modes that stay at rest.
inline constexpr std::size_t lane_padding = 8;

/// Standard allocator whose storage is aligned to vector_alignment.
template <class T>
struct AlignedAllocator {
    using value_type = T;
    AlignedAllocator() = default;
    template <class U>
    AlignedAllocator(const AlignedAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor)
    T* allocate(std::size_t n) {
        return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{vector_alignment}));
    }
    void deallocate(T* p, std::size_t) noexcept { ::operator delete (p, std::align_val_t{vector_alignment}); }
    template <class U>
    bool operator==(const AlignedAllocator<U>&) const noexcept {
        return true;
    }
};

/// std::vector with aligned storage.
template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

/// The smallest multiple of lane_padding that is >= n.
constexpr std::size_t padded(std::size_t n) {
    return (n + lane_padding - 1) / lane_padding * lane_padding;
}

}  // namespace jawari
