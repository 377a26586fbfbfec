// The six zones of a cell as the layers at the ends of its axes: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/common/elastic_constants.hpp"
#include "mechanics/zones/cells.hpp"

#include <array>

namespace kaya {

/// A stress of each zone of eight cells.
using SixZones = std::array<SixEights, zones_of_cell>;

/// The zones that stand for the layers at the two ends of each axis.
struct LayerZones {
    Row upper, lower;
};
constexpr LayerZones layer_zones[3] = {{0, 4}, {1, 3}, {2, 5}};

/// Prefetches numbers that will be written. Inlined: compilers drop calls of functions without visible effect.
[[gnu::always_inline]] inline void bring(const double* first, Row count) {
    for (Row i = 0; i < count; i += eight) __builtin_prefetch(first + i, 1);
}

inline SixZones load_zones(const Column<Stress>& column, Row zone, Row cells) {
    SixZones stress;
    for (Row z = 0; z < zones_of_cell; ++z) stress[z] = load_six(column[zone + z].data(), to_next_cell, cells);
    return stress;
}
inline void store_zones(Column<Stress>& column, Row zone, Row cells, const SixZones& stress) {
    for (Row z = 0; z < zones_of_cell; ++z) store_six(column[zone + z].data(), to_next_cell, cells, stress[z]);
}

inline SixZones sum(const SixZones& a, const SixZones& b) {
    SixZones of_both;
    for (Row z = 0; z < zones_of_cell; ++z) of_both[z] = sum(a[z], b[z]);
    return of_both;
}
inline SixZones difference(const SixZones& a, const SixZones& b) {
    SixZones rest;
    for (Row z = 0; z < zones_of_cell; ++z) rest[z] = difference(a[z], b[z]);
    return rest;
}

/// With the material.
inline void turn(SixZones& stress, const Eight3& half_spin) {
    for (SixEights& zone : stress) zone = turned(zone, half_spin);
}

inline SixEights mean_of(const SixZones& stress) {
    SixEights mean = stress[0];
    for (Row z = 1; z < zones_of_cell; ++z) mean = sum(mean, stress[z]);
    for (Eight& s : mean) s *= 1.0 / zones_of_cell;
    return mean;
}

/// Half of the difference of stress between the layers of an axis.
inline SixEights layer_stress(const SixZones& stress, std::size_t axis) {
    SixEights half = difference(stress[layer_zones[axis].upper], stress[layer_zones[axis].lower]);
    for (Eight& s : half) s *= 0.5;
    return half;
}

/// The product of two vectors as a symmetric tensor.
[[gnu::always_inline]] inline SixEights tensor(const Eight3& a, const Eight3& b) {
    return {a.x * b.x,
            a.y * b.y,
            a.z * b.z,
            0.5 * (a.x * b.y + a.y * b.x),
            0.5 * (a.x * b.z + a.z * b.x),
            0.5 * (a.y * b.z + a.z * b.y)};
}

/// The plane of the layers of one axis, spanned by the two others, b and c.
struct LayerPlane {
    /// The strain of the upper layer by a component of 1 in its plane, bb, cc or both bc: an elastic layer becomes thinner or thicker by it
    /// such that it takes no stress across itself. Their products with a stress are the components that do the work.
    std::array<SixEights, 3> part;
    SixEights across; ///< of the normal with itself

    LayerPlane() = default;
    [[gnu::always_inline]] LayerPlane(const std::array<Eight3, 3>& axes, std::size_t axis,
                                      const ElasticConstants& elastic) {
        const Eight3 &b = axes[(axis + 1) % 3], &c = axes[(axis + 2) % 3], n = b.cross(c);
        const Eight bb = b.dot(b), cc = c.dot(c), bc = b.dot(c), r = 1.0 / (bb * cc - bc * bc);
        const std::array<Eight, 3> metric{cc * r, bb * r, -bc * r}; // inverse: bb, cc, bc
        const Eight3 dual_b = b * metric[0] + c * metric[2], dual_c = b * metric[2] + c * metric[1];
        across = tensor(n, n * r);
        part = {tensor(dual_b, dual_b), tensor(dual_c, dual_c), tensor(dual_b, dual_c)};
        const double whole = elastic.lambda + elastic.two_shear, thinner = whole > 0 ? elastic.lambda / whole : 0;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 6; ++k) part[i][k] -= thinner * metric[i] * across[k];
    }

    /// The strain of the upper layer with these components bb, cc and bc.
    [[gnu::always_inline]] SixEights strain(const Eight* own) const {
        SixEights strain;
        for (std::size_t k = 0; k < 6; ++k)
            strain[k] = own[0] * part[0][k] + own[1] * part[1][k] + 2.0 * own[2] * part[2][k];
        return strain;
    }
};

using LayerPlanes = std::array<LayerPlane, 3>;
[[gnu::always_inline]] inline LayerPlanes planes_of(const std::array<Eight3, 3>& axes,
                                                    const ElasticConstants& elastic) {
    return {LayerPlane(axes, 0, elastic), LayerPlane(axes, 1, elastic), LayerPlane(axes, 2, elastic)};
}

/// Stress that the motion of cells has made: the mean, and that of their layers and fibres.
struct MadeStress {
    SixEights mean;
    WarpStress warp;
};

/// Of cells with these stresses of their zones; that of fibres is 0.
[[gnu::always_inline]] inline MadeStress made_stress(const LayerPlanes& planes, const SixZones& stress) {
    MadeStress made{mean_of(stress), {}};
    for (std::size_t a = 0; a < 3; ++a) {
        const SixEights layer = layer_stress(stress, a);
        for (std::size_t k = 0; k < 3; ++k) made.warp[3 * a + k] = product(layer, planes[a].part[k]);
    }
    return made;
}

} // namespace kaya
