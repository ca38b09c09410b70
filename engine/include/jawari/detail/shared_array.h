// Large constant tables that copies of a model share.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "jawari/detail/aligned.h"

namespace jawari {

/// An aligned vector that is filled once, by compile(), and shared by copies from then on: copying neither
/// allocates nor copies. The storage lives as long as one of its holders.
template <class T>
class SharedArray {
  public:
    SharedArray() = default;

    [[nodiscard]] std::size_t size() const { return values_ ? values_->size() : 0; }
    [[nodiscard]] bool empty() const { return size() == 0; }
    [[nodiscard]] const T* data() const { return values_ ? values_->data() : nullptr; }
    [[nodiscard]] T* data() { return values_ ? values_->data() : nullptr; }
    const T& operator[](std::size_t i) const { return (*values_)[i]; }
    T& operator[](std::size_t i) { return (*values_)[i]; }
    [[nodiscard]] const T* begin() const { return data(); }
    [[nodiscard]] const T* end() const { return data() + size(); }

    /// New storage; other holders keep theirs.
    void assign(std::size_t n, T value) { values_ = std::make_shared<AlignedVector<T>>(n, value); }
    /// While filling: to storage that nobody shares yet.
    template <class Row>
    void append(const Row& row) {
        if (!values_) values_ = std::make_shared<AlignedVector<T>>();
        values_->insert(values_->end(), row.begin(), row.end());
    }

  private:
    std::shared_ptr<AlignedVector<T>> values_;
};

}  // namespace jawari
