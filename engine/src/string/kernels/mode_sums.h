// The loops over modes, written once over a lane type (Highway) and dispatched at run time. Arrays are padded
// and aligned as aligned.h says. Sums differ between instruction sets by rounding only.
#pragma once

#include <cstddef>
#include <cstdint>

namespace jawari::kernels {

/// out <- carry v + change v + restoring q
void free_velocity(std::size_t n, const double* carry, const double* change, const double* restoring,
                   const double* q, const double* v, double* out) noexcept;

/// sum_{k<n} row[k] x[k]
double row_product(std::size_t n, const double* row, const double* x) noexcept;

/// out[c] = sum_{k<n} rows[c * stride + k] x[k], c < rows_count
void row_products(std::size_t rows_count, std::size_t n, std::size_t stride, const double* rows,
                  const double* x, double* out) noexcept;

/// out[c] = sum_{k<n} rows[c * stride + k] x[k] for the `count` rows c that `indices` names
void indexed_row_products(const std::uint32_t* indices, std::size_t count, std::size_t n, std::size_t stride,
                          const double* rows, const double* x, double* out) noexcept;

/// y[k] += sum of scales[c] rows[c * stride + k] over the `count` rows c that `indices` names, k < n
void add_rows(const std::uint32_t* indices, std::size_t count, const double* scales, std::size_t n,
              std::size_t stride, const double* rows, double* y) noexcept;

/// v <- v + scale mobility row: what an impulse or a force at one point does to the modes
void add_impulse(std::size_t n, double scale, const double* mobility, const double* row, double* v) noexcept;

/// v <- v + sum of impulses[c] mobility row_c over the `count` rows c that `indices` names and whose impulse
/// is not 0, one after the other: the numbers are those of add_impulse() for each
void add_impulses(const std::uint32_t* indices, std::size_t count, const double* impulses, std::size_t n,
                  std::size_t stride, const double* mobility, const double* rows, double* v) noexcept;

/// y <- y + scale x
void add_scaled(std::size_t n, double scale, const double* x, double* y) noexcept;

/// sum <- sum of scales[i] rows[i], i < count >= 1, over n modes.
void sum_rows(std::size_t n, std::size_t count, const double* scales, const double* const* rows,
              double* sum) noexcept;

/// sum_k kinetic v^2 + potential (q - lag v)^2
double energy(std::size_t n, const double* kinetic, const double* potential, double lag, const double* q,
              const double* v) noexcept;

/// sum_k weight (now x_now + before x_before)^2
double weighted_square(std::size_t n, const double* weight, double now, const double* x_now, double before,
                       const double* x_before) noexcept;

/// True if all values are finite.
bool all_finite(std::size_t n, const double* x) noexcept;

/// Name of the instruction set in use.
const char* instruction_set() noexcept;

}  // namespace jawari::kernels
