// Denormal numbers cost some processors a hundred cycles each.
#pragma once

#include <cstdint>

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace jawari {

/// While a guard lives, results below 2.2e-308 in size are zero on its thread; its end restores the mode.
/// Make one around every call of render(), render_instrument() and advance_frame(): strings that die away
/// pass through denormal numbers, which made the engine's own benchmarks slower by a factor of twelve.
/// Samples rendered with and without a guard may differ in their last bits. Does nothing on processors other
/// than x86-64 and ARM64. Threads: one, the thread that made it; realtime-safe.
class NoDenormals {
  public:
    NoDenormals() noexcept : saved_(control()) { set_control(saved_ | flush_bits); }
    ~NoDenormals() { set_control(saved_); }
    NoDenormals(const NoDenormals&) = delete;
    NoDenormals& operator=(const NoDenormals&) = delete;
    NoDenormals(NoDenormals&&) = delete;
    NoDenormals& operator=(NoDenormals&&) = delete;

  private:
#if defined(__SSE2__) || defined(_M_X64)
    using Word = unsigned;
    static constexpr Word flush_bits = 0x8040;  // FTZ and DAZ of MXCSR
    static Word control() noexcept {
        return _mm_getcsr();
    }
    static void set_control(Word word) noexcept {
        _mm_setcsr(word);
    }
#elif defined(__aarch64__) && !defined(_MSC_VER)
    using Word = std::uint64_t;
    static constexpr Word flush_bits = Word{1} << 24;  // FZ of FPCR
    static Word control() noexcept {
        Word word = 0;
        asm volatile("mrs %0, fpcr" : "=r"(word));
        return word;
    }
    static void set_control(Word word) noexcept {
        asm volatile("msr fpcr, %0" : : "r"(word));
    }
#else
    using Word = unsigned;
    static constexpr Word flush_bits = 0;
    static Word control() noexcept {
        return 0;
    }
    static void set_control(Word) noexcept {}
#endif
    Word saved_;
};

}  // namespace jawari
