#include "laws/guard.hpp"

#include "laws/law_table.hpp"
#include "system/run_record.hpp"

#include <atomic>
#include <bit>

namespace kaya {

namespace {

std::atomic<bool> fences_all = false;

} // namespace

Guard guard_in_cycle(const LawTable& law, std::int64_t cycle, std::int64_t batch) {
    constexpr std::int64_t between = 128;
    if (!law.who()->foreign) return Guard::in_cycle;
    const bool is_due = (cycle + batch) % between == 0 || std::has_single_bit(static_cast<std::uint64_t>(cycle));
    return is_due || fences_all.load(std::memory_order_relaxed) ? Guard::fenced : Guard::in_cycle;
}

void fence_all_calls(bool all) { fences_all = all; }

} // namespace kaya
