// Denormal numbers cost some processors a hundred cycles each: while a guard lives, results below 2.2e-308
// are zero. Live playing and rendering to files both use it, so that they give the same bits; simulations use
// it too, or strings that die away without skipping would pass through them.
#pragma once

#include <cstdint>

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace jawari {

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
