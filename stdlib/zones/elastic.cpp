// Zone model `elastic`: linear and isotropic. docs/zone-models/elastic.md has the equations.
#include "stdlib/zones/zone.hpp"

namespace {

using namespace kaya::zones;

ptrdiff_t run(kaya_zbatch* batch) {
    add_elastic(*batch, {batch->properties[0], batch->properties[1]});
    return -1;
}

constexpr std::array properties{bulk_property, shear_property};
constexpr std::array<kaya_jhistory, 0> history{};
constexpr kaya_zmodel descriptor = model("elastic", "linear isotropic elasticity", properties, history, "", false, run);

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
