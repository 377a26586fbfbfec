// A zone model that fails as its property `what` says: 1 throws, 2 returns NaN stress, 3 returns an invalid row, 4 fails with a sentence, 5
// returns NaN history; otherwise it does nothing.
#include "stdlib/zones/zone.hpp"

#include <cstdio>
#include <limits>
#include <stdexcept>

namespace {

using namespace kaya::zones;

constexpr std::array properties{bulk_property, shear_property,
                                kaya_zproperty{"what", "", "-", "what it does", 0, 0, 9, 0, KAYA_ZREDUCE_NONE}};
constexpr std::array<kaya_jhistory, 1> history{{{"kept", "-", "nothing"}}};

ptrdiff_t run(kaya_zbatch* batch) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    switch (static_cast<int>(batch->properties[2])) {
    case 1: throw std::runtime_error("it does not like this zone");
    case 2: batch->stress[3][batch->n - 1] = nan; return -1;
    case 3: return static_cast<ptrdiff_t>(batch->n);
    case 4: std::snprintf(batch->message, sizeof batch->message, "the rock is tired"); return 0;
    case 5: batch->history[0][0] = nan; return -1;
    default: return -1;
    }
}

constexpr kaya_zmodel descriptor = model("misbehaves", "does what it is told", properties, history, "", false, run);

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
