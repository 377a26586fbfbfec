// How the processor rounds, and what foreign code does to it.
#pragma once

#include <string>

namespace kaya {

/// Remembers how the processor rounds in this thread and whether it keeps very small numbers, and puts that back: a library
/// that was linked with -ffast-math, or a model that switches something and forgets it, would change all results
/// after it, in some threads and not in others.
class ArithmeticGuard {
public:
    ArithmeticGuard();
    ~ArithmeticGuard() { put_back(); }
    ArithmeticGuard(const ArithmeticGuard&) = delete;
    ArithmeticGuard& operator=(const ArithmeticGuard&) = delete;

    /// What had been changed, as bits of ArithmeticChange; 0: nothing.
    unsigned put_back();

private:
    unsigned control_;
    int rounding_;
};

enum ArithmeticChange : unsigned { rounding_changed = 1, small_numbers_cut = 2, stops_at_errors = 4 };

/// "how numbers are rounded, and that very small numbers are kept"
std::string text_of_changes(unsigned changes);

} // namespace kaya
