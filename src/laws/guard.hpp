// How closely a call of a law is checked.
#pragma once

#include <cstdint>

namespace kaya {

class LawTable;

enum class Guard {
    in_cycle, ///< cheap checks: the cycle sums forces and work, detects invalid numbers by the sums, and then calls
              ///< unusable_output(); stiffnesses only when the model reports that it wrote some
    all,      ///< all outputs
    fenced,   ///< all outputs, and all writes outside of the law's columns: it works on copies between fences
};

/// How a call in a cycle is guarded. Each batch of a foreign law is fenced once in 128 cycles, and in cycles whose number is a power of two, to
/// detect a law that starts to write outside of its columns late in a run; and in all cycles where its owner wants it (LawTable::fence_all_calls). `batch` is its number, the same in each run.
Guard guard_in_cycle(const LawTable& law, std::int64_t cycle, std::int64_t batch);

} // namespace kaya
