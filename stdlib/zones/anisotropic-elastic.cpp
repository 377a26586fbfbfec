// Zone model `anisotropic-elastic`: linear elasticity that is the same in all directions of a plane.
// docs/zone-models/anisotropic-elastic.md has the equations, (n) below are their numbers.
#include "stdlib/zones/turning.hpp"

#include <algorithm>

namespace {

using namespace kaya::zones;

enum Property : std::size_t {
    young_plane,
    young_normal,
    poisson_plane,
    poisson_normal,
    shear_normal,
    dip,
    dip_direction
};
constexpr std::array properties{
    kaya_zproperty{"young-plane", "eplane", "stress", "Young's modulus along the planes", NAN, 0, INFINITY, 0,
                   KAYA_ZREDUCE_NONE},
    kaya_zproperty{"young-normal", "enormal", "stress", "Young's modulus across the planes", NAN, 0, INFINITY, 0,
                   KAYA_ZREDUCE_NONE},
    kaya_zproperty{"poisson-plane", "nuplane", "-", "strain along the planes for a load along them", 0, -1, 1, 0,
                   KAYA_ZREDUCE_NONE},
    kaya_zproperty{"poisson-normal", "nunormal", "-", "strain along the planes for a load across them", 0, -10, 10, 0,
                   KAYA_ZREDUCE_NONE},
    kaya_zproperty{"shear-normal", "gnormal", "stress", "shear modulus along the planes; as (3) if not given", NAN, 0,
                   INFINITY, 1, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"dip", "", "angle", "dip of the planes", 0, 0, 90, 0, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"dip-direction", "dd", "angle", "dip direction of the planes, clockwise from y", 0, 0, 360, 0,
                   KAYA_ZREDUCE_NONE},
};
enum History : std::size_t { plastic_shear, plastic_tension, turn };
constexpr std::array<kaya_jhistory, 6> history{{
    {"plastic-shear", "-", "always 0: fields of plastic strain read the first two variables of any model"},
    {"plastic-tension", "-", "always 0"},
    turn_history[0],
    turn_history[1],
    turn_history[2],
    turn_history[3],
}};

/// The factor of the plane's modulus that both of Poisson's ratios leave; above 0 where deformation always takes work.
double rest_of(const double* p) {
    return 1 - p[poisson_plane] - 2 * p[poisson_normal] * p[poisson_normal] * p[young_plane] / p[young_normal];
}

/// Components of the stiffness, axis 3 across the planes (2).
struct Stiffness {
    double c11, c12, c13, c33, along, across; ///< the last two: shear moduli in a plane, and along it on its face

    explicit Stiffness(const double* p) {
        const double e = p[young_plane], en = p[young_normal], nu = p[poisson_plane], nun = p[poisson_normal];
        const double square = nun * nun * e / en, rest = rest_of(p);
        c11 = e * (1 - square) / ((1 + nu) * rest);
        c12 = e * (nu + square) / ((1 + nu) * rest);
        c13 = e * nun / rest;
        c33 = en * (1 - nu) / rest;
        along = e / (2 * (1 + nu));
        across = std::isnan(p[shear_normal]) ? 1 / (1 / e + (1 + 2 * nun) / en) : p[shear_normal];
    }
};

ptrdiff_t run(kaya_zbatch* batch) {
    const double* p = batch->properties;
    const Stiffness c(p);
    const auto normal = plane_normal(p[dip], p[dip_direction]);
    const double couple = c.c13 - c.c12, shear = 2 * (c.across - c.along);
    const double straight = c.c33 - c.c12 - 2 * c.along - 2 * couple - 2 * shear;
    constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
    for (std::size_t i = 0; i < batch->n; ++i) {
        const Tensor e = strain_of(*batch, i);
        const auto n = turned(*batch, turn, i, normal);
        const double v[3] = {e[0] * n[0] + e[3] * n[1] + e[4] * n[2], e[3] * n[0] + e[1] * n[1] + e[5] * n[2],
                             e[4] * n[0] + e[5] * n[1] + e[2] * n[2]};
        const double volume = e[0] + e[1] + e[2], opens = v[0] * n[0] + v[1] * n[1] + v[2] * n[2];
        const double on_normal = couple * volume + straight * opens;
        Tensor stress = stress_of(*batch, i);
        for (int k = 0; k < 6; ++k) { // (4)
            const int a = row[k], b = column[k];
            stress[k] += 2 * c.along * e[k] + on_normal * n[a] * n[b] + shear * (n[a] * v[b] + v[a] * n[b]);
            if (k < 3) stress[k] += c.c12 * volume + couple * opens;
        }
        put_stress(*batch, i, stress);
    }
    return -1;
}

const char* check(const double* p) {
    if (!(p[young_plane] > 0 && p[young_normal] > 0)) return "young-plane and young-normal must be above 0";
    if (!(std::abs(p[poisson_plane]) < 1)) return "poisson-plane must lie between -1 and 1";
    if (!(rest_of(p) > 0))
        return "deforming would give out work: 1 - poisson-plane must be above 2 poisson-normal^2 young-plane / young-normal; give a smaller poisson-normal";
    if (!(Stiffness(p).across > 0)) return "shear-normal must be above 0";
    return nullptr;
}

/// An isotropic stiffness that takes at least the energy of this one for every strain (5).
void bounding_moduli(const double* p, double* bulk, double* shear) {
    const Stiffness c(p);
    const double mean = (2 * c.c11 + 2 * c.c12 + 4 * c.c13 + c.c33) / 3,
                 deviator = (c.c11 + c.c12 - 4 * c.c13 + 2 * c.c33) / 3;
    const double both = std::sqrt(2.0) / 3 * (c.c13 + c.c33 - c.c11 - c.c12);
    const double twice = std::max({deviator + std::abs(both) / std::sqrt(2.0), 2 * c.along, 2 * c.across});
    const double more = both == 0 ? 0 : both * both / (twice - deviator);
    *bulk = (mean + more) / 3;
    *shear = twice / 2;
}

constexpr kaya_zmodel descriptor = model("anisotropic-elastic", "linear elasticity, isotropic in a plane", properties,
                                         history, "", false, run, check, bounding_moduli);

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
