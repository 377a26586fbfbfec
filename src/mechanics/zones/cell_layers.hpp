// The six zones of a cell as the layers at the ends of its axes: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/common/elastic_constants.hpp"
#include "mechanics/zones/cells.hpp"

#include <algorithm>
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

[[gnu::always_inline]] inline SixZones load_zones(const Column<Stress>& column, Row zone, Row cells) {
    SixZones stress;
    for (Row z = 0; z < zones_of_cell; ++z) stress[z] = load_six(column[zone + z].data(), to_next_cell, cells);
    return stress;
}
[[gnu::always_inline]] inline void store_zones(Column<Stress>& column, Row zone, Row cells, const SixZones& stress) {
    for (Row z = 0; z < zones_of_cell; ++z) store_six(column[zone + z].data(), to_next_cell, cells, stress[z]);
}

[[gnu::always_inline]] inline SixZones sum(const SixZones& a, const SixZones& b) {
    SixZones of_both;
    for (Row z = 0; z < zones_of_cell; ++z) of_both[z] = sum(a[z], b[z]);
    return of_both;
}
[[gnu::always_inline]] inline SixZones difference(const SixZones& a, const SixZones& b) {
    SixZones rest;
    for (Row z = 0; z < zones_of_cell; ++z) rest[z] = difference(a[z], b[z]);
    return rest;
}

/// With the material.
inline void turn(SixZones& stress, const Eight3& half_spin) {
    for (SixEights& zone : stress) zone = turned(zone, half_spin);
}

[[gnu::always_inline]] inline SixEights mean_of(const SixZones& stress) {
    SixEights mean = stress[0];
    for (Row z = 1; z < zones_of_cell; ++z) mean = sum(mean, stress[z]);
    for (Eight& s : mean) s *= 1.0 / zones_of_cell;
    return mean;
}

/// Half of the difference of stress between the layers of an axis.
[[gnu::always_inline]] inline SixEights layer_stress(const SixZones& stress, std::size_t axis) {
    SixEights half = difference(stress[layer_zones[axis].upper], stress[layer_zones[axis].lower]);
    for (Eight& s : half) s *= 0.5;
    return half;
}

/// The product of two vectors as a tensor, on and above its diagonal: of parallel vectors, or part of a sum that is symmetric.
[[gnu::always_inline]] inline SixEights tensor(const Eight3& a, const Eight3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z, a.x * b.y, a.x * b.z, a.y * b.z};
}

/// The plane of the layers of one axis, spanned by the two others, b and c. A layer whose strain has the components bb, cc and bc in its plane
/// becomes thinner or thicker such that it takes no stress across itself while it is elastic.
struct LayerPlane {
    Eight3 dual_b, dual_c; ///< vectors in the plane: products with b and c are 0 or 1
    SixEights across;      ///< of the normal with itself
    Eight bb, cc, bc;      ///< products of the dual vectors
    double thinner;        ///< strain across elastic layers over the trace of that in their plane, with the other sign

    LayerPlane() = default;
    [[gnu::always_inline]] LayerPlane(const std::array<Eight3, 3>& axes, std::size_t axis,
                                      const ElasticConstants& elastic) {
        const Eight3 &b = axes[(axis + 1) % 3], &c = axes[(axis + 2) % 3], n = b.cross(c);
        const Eight square_b = b.dot(b), square_c = c.dot(c), of_both = b.dot(c),
                    r = 1.0 / (square_b * square_c - of_both * of_both);
        bb = square_c * r, cc = square_b * r, bc = -of_both * r;
        dual_b = b * bb + c * bc, dual_c = b * bc + c * cc;
        across = tensor(n, n * r);
        const double whole = elastic.lambda + elastic.two_shear;
        thinner = whole > 0 ? elastic.lambda / whole : 0;
    }

    /// The strain of the upper layer with these components bb, cc and bc.
    [[gnu::always_inline]] SixEights strain(const Eight* own) const {
        const Eight thickening = -thinner * (own[0] * bb + own[1] * cc + 2.0 * own[2] * bc);
        SixEights strain = tensor(dual_b, dual_b * own[0] + dual_c * own[2]);
        const SixEights rest = tensor(dual_c, dual_b * own[2] + dual_c * own[1]);
        for (std::size_t k = 0; k < 6; ++k) strain[k] = strain[k] + rest[k] + thickening * across[k];
        return strain;
    }

    /// The components bb, cc and bc of a stress that do the work of such strains.
    [[gnu::always_inline]] std::array<Eight, 3> components(const SixEights& s) const {
        const auto on = [&](const Eight3& v) {
            return Eight3{s[0] * v.x + s[3] * v.y + s[4] * v.z, s[3] * v.x + s[1] * v.y + s[5] * v.z,
                          s[4] * v.x + s[5] * v.y + s[2] * v.z};
        };
        const Eight3 on_b = on(dual_b), on_c = on(dual_c);
        const Eight pressed = thinner * product(s, across);
        return {on_b.dot(dual_b) - pressed * bb, on_c.dot(dual_c) - pressed * cc, on_b.dot(dual_c) - pressed * bc};
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
        const std::array<Eight, 3> layer = planes[a].components(layer_stress(stress, a));
        std::copy(layer.begin(), layer.end(), &made.warp[3 * a]);
    }
    return made;
}

} // namespace kaya
