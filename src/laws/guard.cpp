#include "laws/guard.hpp"

#include "laws/law_table.hpp"
#include "system/run_record.hpp"

#include <bit>

namespace kaya {

Guard guard_in_cycle(const LawTable& law, std::int64_t cycle, std::int64_t batch) {
    constexpr std::int64_t between = 128;
    if (!law.who()->foreign) return Guard::in_cycle;
    const bool is_due = (cycle + batch) % between == 0 || std::has_single_bit(static_cast<std::uint64_t>(cycle));
    return is_due || law.fences_all_calls() ? Guard::fenced : Guard::in_cycle;
}

} // namespace kaya
