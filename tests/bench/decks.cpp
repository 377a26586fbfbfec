// Time of cycles. A deck creates a model, then cycles are timed on one thread.
#include "run.hpp"

#include <fmt/format.h>

namespace {

/// A deck and the number of cycles to time.
struct Timed {
    const char *name, *deck;
    std::int64_t cycles;
    bool rebuilding = false;
};

constexpr Timed timed[] = {
    {"direct_shear_with_fish", "direct-shear.3dd", 20000},
    {"direct_shear", "direct-shear-no-fish.3dd", 20000},
    {"packed_cubes_1000", "packed-cubes-10.3dd", 1000},
    {"packed_cubes_1000_fine", "packed-cubes-fine.3dd", 1000},
    {"packed_cubes_1000_rebuilt", "packed-cubes-10.3dd", 100, true},
    {"one_rigid_block", "one-block.3dd", 100000},
};

} // namespace

int main() {
    fmt::print("{:<28}{:>10}{:>14}{:>10}{:>14}\n", "deck", "cycles", "us per cycle", "zones", "sub-contacts");
    for (const Timed& one : timed) {
        bench::Run run(one.deck);
        const double start = bench::seconds();
        if (one.rebuilding) run.rebuilding_cycles(one.cycles);
        else run.cycles(one.cycles);
        const double spent = bench::seconds() - start;
        fmt::print("{:<28}{:>10}{:>14.3f}{:>10}{:>14}\n", one.name, one.cycles,
                   1e6 * spent / static_cast<double>(one.cycles), run.model().zones.size(),
                   run.model().sub_contacts.size());
    }
}
