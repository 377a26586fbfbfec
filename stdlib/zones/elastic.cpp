// Zone model `elastic`: linear and isotropic. docs/zone-models/elastic.md has the equations.
#include "stdlib/zones/zone.hpp"

namespace {

using namespace kaya::zones;

ptrdiff_t run(kaya_zbatch* batch) {
    const Moduli moduli{batch->properties[0], batch->properties[1]};
    const double two_shear = 2 * moduli.shear, lame = moduli.lame();
    const std::size_t n = batch->n;
    for (int k = 0; k < 3; ++k) {
        double *__restrict normal = batch->stress[k], *__restrict shear = batch->stress[k + 3];
        const double *xx = batch->strain_inc[0], *yy = batch->strain_inc[1], *zz = batch->strain_inc[2];
        const double *own = batch->strain_inc[k], *sheared = batch->strain_inc[k + 3];
        for (std::size_t i = 0; i < n; ++i) {
            normal[i] = (normal[i] + two_shear * own[i]) + lame * (xx[i] + yy[i] + zz[i]);
            shear[i] += two_shear * sheared[i];
        }
    }
    return -1;
}

constexpr std::array properties{bulk_property, shear_property};
constexpr std::array<kaya_jhistory, 0> history{};
constexpr kaya_zmodel descriptor = model("elastic", "linear isotropic elasticity", properties, history, "", false, run);

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
