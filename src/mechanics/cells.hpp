// Cells of six zones that bend and twist as hexahedra do, eight at a time: docs/theory/zones.md.
#pragma once

#include "mechanics/tetrahedra.hpp"

#include <array>

namespace kaya {

constexpr Row zones_of_cell = 6;

/// The corners of eight cells: corner i + 2 j + 4 k stands at the ends i, j, k of the three axes of its cell.
using CellCorners = std::array<std::array<Row, 8>, 8>; ///< by corner and lane, as points of a tile

/// Those of the cell whose six zones begin at `zones`, in the order of the walks of hexahedron_mesh.
inline std::array<Row, 8> corners_of_cell(const std::array<Row, 4>* zones) {
    return {zones[0][0], zones[0][1], zones[1][1], zones[0][2], zones[2][1], zones[2][2], zones[1][2], zones[0][3]};
}

using EightCorners = std::array<Eight3, 8>;

inline EightCorners load_corners(const PointRow* rows, const CellCorners& corners) {
    EightCorners loaded;
    for (std::size_t c = 0; c < 8; ++c) {
        std::array<Four, 8> r;
        for (std::size_t l = 0; l < 8; ++l) r[l] = load_as<Four>(rows[corners[c][l]].value.data());
        const std::array<Eight, 4> columns = columns_of_rows(r);
        loaded[c] = {columns[0], columns[1], columns[2]};
    }
    return loaded;
}

/// What of a field over the corners is no linear field: coefficients of the products of two of the axes, each under the number of
/// the third, and of all three.
using Warps = std::array<Eight3, 4>;

/// Sums of a field over the corners with the signs of the four products.
inline Warps warps_of(const EightCorners& f) {
    const auto sum = [&](unsigned axes) {
        Eight3 whole = f[7];
        for (unsigned c = 0; c < 7; ++c) whole = __builtin_popcount(~c & axes) % 2 == 0 ? whole + f[c] : whole - f[c];
        return whole;
    };
    return {sum(6), sum(5), sum(3), sum(7)};
}

/// Shape of cells in one configuration.
struct CellShape {
    std::array<Eight3, 3> axis;     ///< halves of the mean edges
    std::array<Eight3, 8> gradient; ///< of the mean of a field over the zones of the cell, times the volume
    Warps warp;                     ///< of the places of the corners
    Eight volume;

    explicit CellShape(const EightCorners& x) : warp(warps_of(x)) {
        for (unsigned a = 0; a < 3; ++a) {
            axis[a] = x[7] - x[0];
            for (unsigned c = 1; c < 7; ++c) axis[a] = (c >> a & 1) != 0 ? axis[a] + x[c] : axis[a] - x[c];
            axis[a] = axis[a] * eights(0.125);
        }
        // The change of the volume with the place of a corner; all zones have the edge from corner 0 to corner 7.
        const Eight3 diagonal = x[7] - x[0];
        static constexpr std::array<unsigned, 6> around{1, 3, 2, 6, 4, 5};
        const Eight sixth = eights(1.0 / 6);
        gradient.fill({Eight{}, Eight{}, Eight{}});
        Eight six_volumes{};
        for (std::size_t k = 0; k < 6; ++k) {
            const unsigned p = around[k], q = around[(k + 1) % 6];
            const Eight3 ep = x[p] - x[0], eq = x[q] - x[0];
            const Eight3 np = eq.cross(diagonal) * sixth, nq = diagonal.cross(ep) * sixth, n7 = ep.cross(eq) * sixth;
            gradient[p] = gradient[p] + np;
            gradient[q] = gradient[q] + nq;
            gradient[7] = gradient[7] + n7;
            gradient[0] = gradient[0] - (np + nq + n7);
            six_volumes += diagonal.dot(ep.cross(eq));
        }
        volume = six_volumes * sixth;
    }
};

/// How cells resist warping: numbers that turn with the cell. For each axis the stress of its layers at the end of the axis, as
/// bb, cc and bc of the other two axes; then the stress along each axis for the product of all three.
using WarpStress = std::array<Eight, 12>;

/// The warp stresses of eight cells, or of as many as there are, whose zones follow each other from one on.
inline WarpStress load_warps(const Zones& zones, std::size_t column, Row first, Row count) {
    WarpStress stress{};
    for (Row l = 0; l < count; ++l)
        for (Row k = 0; k < 12; ++k)
            stress[static_cast<std::size_t>(k)][l] =
                zones.history[column + static_cast<std::size_t>(k / 6)][first + zones_of_cell * l + k % 6];
    return stress;
}
inline void store_warps(Zones& zones, std::size_t column, Row first, Row count, const WarpStress& stress) {
    for (Row l = 0; l < count; ++l)
        for (Row k = 0; k < 12; ++k)
            zones.history[column + static_cast<std::size_t>(k / 6)][first + zones_of_cell * l + k % 6] =
                stress[static_cast<std::size_t>(k)][l];
}

/// Moduli of layers under no pressure from one to the next, and of fibres.
struct LayerModuli {
    double lambda = 0, two_shear = 0, young = 0;

    explicit LayerModuli(double of_volume, double twice_shear) : two_shear(twice_shear) {
        const double whole = of_volume + twice_shear;
        if (!(twice_shear > 0) || !(whole > 0)) return;
        lambda = of_volume * twice_shear / whole;
        young = 0.5 * twice_shear * (3 * of_volume + twice_shear) / (of_volume + 0.5 * twice_shear);
    }
};

/// What the warps of a step add to the stress. Returns the work of the step, by cell.
inline Eight add_warp_stress(const CellShape& shape, const EightCorners& shift, const LayerModuli& moduli,
                             WarpStress& stress) {
    const Eight over = 1.0 / shape.volume;
    Warps g = warps_of(shift);
    for (std::size_t h = 0; h < 4; ++h) {
        Eight3 linear{Eight{}, Eight{}, Eight{}};
        for (std::size_t c = 0; c < 8; ++c) linear = linear + shift[c] * shape.gradient[c].dot(shape.warp[h]);
        g[h] = (g[h] - linear * over) * eights(0.125);
    }
    const Eight lambda = eights(moduli.lambda), two_shear = eights(moduli.two_shear);
    Eight layers{}, fibres{};
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
        const Eight3 &jb = shape.axis[b], &jc = shape.axis[c];
        const Eight bb = jb.dot(g[c]), cc = jc.dot(g[b]), bc = 0.5 * (jb.dot(g[b]) + jc.dot(g[c]));
        const Eight mb = jb.dot(jb), mc = jc.dot(jc), m = jb.dot(jc), r = 1.0 / (mb * mc - m * m);
        const Eight ib = mc * r, ic = mb * r, i = -m * r; // inverse of the metric
        const Eight trace = lambda * (ib * bb + ic * cc + 2.0 * i * bc);
        const std::array<Eight, 3> change{ib * trace + two_shear * (ib * ib * bb + 2.0 * ib * i * bc + i * i * cc),
                                          ic * trace + two_shear * (ic * ic * cc + 2.0 * ic * i * bc + i * i * bb),
                                          i * trace + two_shear * (ib * i * bb + (ib * ic + i * i) * bc + ic * i * cc)};
        Eight* const s = &stress[3 * a];
        layers += (s[0] + 0.5 * change[0]) * bb + (s[1] + 0.5 * change[1]) * cc + (2.0 * s[2] + change[2]) * bc;
        for (std::size_t k = 0; k < 3; ++k) s[k] += change[k];
        const Eight3& ja = shape.axis[a];
        const Eight along = ja.dot(g[3]) / ja.dot(ja), more = moduli.young * along;
        fibres += (stress[9 + a] + 0.5 * more) * along;
        stress[9 + a] += more;
    }
    // Means over the cell of the squares of one axis, and of a product of two.
    return shape.volume * (layers * (1.0 / 3) + fibres * (1.0 / 9));
}

/// Forces on the corners.
inline EightCorners warp_forces(const CellShape& shape, const WarpStress& stress) {
    Warps force;
    force.fill({Eight{}, Eight{}, Eight{}});
    const Eight third = shape.volume * (-1.0 / 24), ninth = shape.volume * (-1.0 / 72); // and 1/8 of the coefficients
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
        const Eight* const s = &stress[3 * a];
        const Eight3 &ja = shape.axis[a], &jb = shape.axis[b], &jc = shape.axis[c];
        force[c] = force[c] + (jb * s[0] + jc * s[2]) * third;
        force[b] = force[b] + (jc * s[1] + jb * s[2]) * third;
        force[3] = force[3] + ja * (stress[9 + a] * ninth / ja.dot(ja));
    }
    const Eight over = 1.0 / shape.volume;
    EightCorners forces;
    for (unsigned c = 0; c < 8; ++c) {
        Eight3 whole = force[3] * eights(__builtin_popcount(~c & 7u) % 2 == 0 ? 1 : -1);
        for (std::size_t h = 0; h < 3; ++h) {
            const unsigned axes = 7u & ~(1u << h);
            whole = __builtin_popcount(~c & axes) % 2 == 0 ? whole + force[h] : whole - force[h];
        }
        for (std::size_t h = 0; h < 4; ++h) whole = whole - force[h] * (shape.gradient[c].dot(shape.warp[h]) * over);
        forces[c] = whole;
    }
    return forces;
}

} // namespace kaya
