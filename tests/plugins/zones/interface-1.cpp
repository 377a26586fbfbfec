// An elastic zone model built for interface 1, whose batch ended before `spin`.
#include "stdlib/zones/zone.hpp"

namespace {
using namespace kaya::zones;
constexpr std::array properties{bulk_property, shear_property};
constexpr std::array<kaya_jhistory, 0> history{};

ptrdiff_t run(kaya_zbatch* batch) {
    add_elastic(*batch, Moduli{batch->properties[0], batch->properties[1]});
    return -1;
}
constexpr kaya_zmodel descriptor = [] {
    kaya_zmodel made = model("interface-1", "elastic", properties, history, "", false, run);
    made.interface_version = 1;
    return made;
}();
} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
