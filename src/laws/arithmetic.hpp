// Rounding mode of the processor, and changes of it by foreign code.
#pragma once

#include <string>

namespace kaya {

/// Saves the rounding mode and the treatment of denormals of this thread, and restores them: a library linked with -ffast-math, or a model
/// that changes a mode and forgets it, would change all later results, in some threads and not in others.
class ArithmeticGuard {
public:
    ArithmeticGuard();
    ~ArithmeticGuard() { put_back(); }
    ArithmeticGuard(const ArithmeticGuard&) = delete;
    ArithmeticGuard& operator=(const ArithmeticGuard&) = delete;

    /// Detected changes as bits of ArithmeticChange; 0: none.
    unsigned put_back();

private:
    unsigned control_;
    int rounding_;
};

enum ArithmeticChange : unsigned { rounding_changed = 1, small_numbers_cut = 2, stops_at_errors = 4 };

/// "how numbers are rounded, and that very small numbers are kept"
std::string text_of_changes(unsigned changes);

} // namespace kaya
