#include "laws/arithmetic.hpp"

#include <cfenv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace kaya {

namespace {

#if defined(__SSE2__)
// MXCSR without the flags of past events.
constexpr unsigned rounding_bits = 0x6000, small_bits = 0x8040, mask_bits = 0x1f80;
unsigned control() { return _mm_getcsr() & (rounding_bits | small_bits | mask_bits); }
void set_control(unsigned bits) { _mm_setcsr((_mm_getcsr() & ~(rounding_bits | small_bits | mask_bits)) | bits); }
#elif defined(__aarch64__)
// FPCR; the masks are enabling bits there.
constexpr unsigned rounding_bits = 3u << 22, small_bits = (1u << 24) | (1u << 19), mask_bits = 0x9f00;
unsigned control() {
    unsigned long value = 0;
    asm volatile("mrs %0, fpcr" : "=r"(value));
    return static_cast<unsigned>(value) & (rounding_bits | small_bits | mask_bits);
}
void set_control(unsigned bits) {
    const unsigned long value = bits;
    asm volatile("msr fpcr, %0" : : "r"(value));
}
#else
constexpr unsigned rounding_bits = ~0u, small_bits = 0, mask_bits = 0;
unsigned control() { return static_cast<unsigned>(std::fegetround()); }
void set_control(unsigned bits) { std::fesetround(static_cast<int>(bits)); }
#endif

} // namespace

ArithmeticGuard::ArithmeticGuard() : control_(control()), rounding_(std::fegetround()) {}

unsigned ArithmeticGuard::put_back() {
    const unsigned changed = control() ^ control_;
    if (changed == 0) return 0;
    if (changed & rounding_bits) std::fesetround(rounding_); // of long double, too
    set_control(control_);
    return (changed & rounding_bits ? unsigned{rounding_changed} : 0u) |
           (changed & small_bits ? unsigned{small_numbers_cut} : 0u) |
           (changed & mask_bits ? unsigned{stops_at_errors} : 0u);
}

std::string text_of_changes(unsigned changes) {
    std::vector<std::string> what;
    if (changes & rounding_changed) what.push_back("how numbers are rounded");
    if (changes & small_numbers_cut) what.push_back("that very small numbers are kept and not cut to 0");
    if (changes & stops_at_errors) what.push_back("that a division by 0 has a result and does not end the program");
    return fmt::format("{}", fmt::join(what, ", "));
}

} // namespace kaya
