// Cells of six zones that bend and twist as hexahedra do, eight at a time: docs/theory/zones.md.
#pragma once

#include "mechanics/tile_rows.hpp"

#include <array>

namespace kaya {

constexpr Row zones_of_group = zones_of_cell * static_cast<Row>(eight); ///< of eight cells
constexpr std::size_t to_next_cell =
    6 * zones_of_cell; ///< from the stresses of a cell to those of the next, in numbers

/// Up to eight cells from one on.
inline Row cells_from(Row zone, Row last) { return std::min<Row>((last - zone) / zones_of_cell, eight); }

/// A field at the corners 1 to 7 of eight cells, from its value at corner 0 on: what all corners have in common leaves nothing, not even
/// rounding. Corner i + 2 j + 4 k stands at the ends i, j, k of the three axes of its cell.
using CellField = std::array<Eight3, 7>;

/// The corners of the six zones of a cell, in the order of hexahedron_mesh.
constexpr std::size_t corners_of_zone[zones_of_cell][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7},
                                                           {0, 1, 7, 5}, {0, 4, 7, 6}, {0, 2, 7, 3}};

inline Edges edges_of_zone(const CellField& field, Row zone) {
    const auto& c = corners_of_zone[zone]; // the first is corner 0
    return {field[c[1] - 1], field[c[2] - 1], field[c[3] - 1]};
}

inline void add_forces_of_zone(const Edges& edges, Row zone, const SixEights& stress, CellForces& forces) {
    const std::array<Eight3, 4> own = forces_of(edges, stress);
    for (std::size_t a = 0; a < 4; ++a) {
        Eight3& sum = forces[corners_of_zone[zone][a]];
        sum = sum + own[a];
    }
}

/// Corners 1 to 7 from corner 0 on. What goes with the points goes to `fourths`, where it is wanted, by corner.
inline CellField from_first(const PointRow* rows, const CellCorners& corners, std::array<Eight, 8>* fourths = nullptr) {
    const EightRow first = load_corner(rows, corners, 0);
    if (fourths) (*fourths)[0] = first.fourth;
    CellField field;
    for (std::size_t c = 1; c < 8; ++c) {
        const EightRow row = load_corner(rows, corners, c);
        field[c - 1] = row.vector - first.vector;
        if (fourths) (*fourths)[c] = row.fourth;
    }
    return field;
}

/// The configuration in which a step strains: its middle, in small strain the only one.
inline CellField strained(const CellField& end, const CellField& shift, bool large) {
    if (!large) return end;
    CellField middle;
    for (std::size_t c = 0; c < 7; ++c) middle[c] = end[c] - shift[c] * eights(0.5);
    return middle;
}

/// Products of the components of stresses and strains.
inline Eight product(const SixEights& stress, const SixEights& strain) {
    return stress[0] * strain[0] + stress[1] * strain[1] + stress[2] * strain[2] +
           2.0 * (stress[3] * strain[3] + stress[4] * strain[4] + stress[5] * strain[5]);
}
inline SixEights sum(const SixEights& a, const SixEights& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]};
}

/// What of a field is no linear field: under the number of each axis that of the product of the two others, then that of all three.
using Warps = std::array<Eight3, 4>;

/// Sums of a field over the corners with the signs that they have along the axes, and with products of those.
struct CornerSums {
    std::array<Eight3, 3> axis;
    Warps warp;

    [[gnu::always_inline]] explicit CornerSums(const CellField& f) {
        // Sums and differences along the first axis, then of these along the second and the third.
        const Eight3 s23 = f[1] + f[2], d23 = f[2] - f[1], s45 = f[3] + f[4], d45 = f[4] - f[3], s67 = f[5] + f[6],
                     d67 = f[6] - f[5];
        const Eight3 ss0 = f[0] + s23, sd0 = s23 - f[0], ds0 = f[0] + d23, dd0 = d23 - f[0];
        const Eight3 ss1 = s45 + s67, sd1 = s67 - s45, ds1 = d45 + d67, dd1 = d67 - d45;
        axis = {ds0 + ds1, sd0 + sd1, ss1 - ss0};
        warp = {sd1 - sd0, ds1 - ds0, dd0 + dd1, dd1 - dd0};
    }
};

/// Shape of cells in one configuration.
struct CellShape {
    std::array<Eight3, 3> axis; ///< halves of the mean edges
    CellField gradient;         ///< of the mean of a field over the zones of the cell, times the volume
    Warps warp;                 ///< of the places of the corners
    Eight volume, least;        ///< least: six times the volume of the smallest zone

    [[gnu::always_inline]] explicit CellShape(const CellField& x) {
        const CornerSums sums(x);
        for (std::size_t a = 0; a < 3; ++a) axis[a] = sums.axis[a] * eights(0.125);
        warp = sums.warp;
        // The change of the volume with the place of a corner. All zones have the edge from corner 0 to corner 7, and each
        // two of the others that follow each other around it.
        static constexpr std::array<std::size_t, 6> around{1, 3, 2, 6, 4, 5};
        const auto corner = [](std::size_t k) { return around[k % 6] - 1; };
        const Eight3 diagonal = x[6];
        const Eight sixth = eights(1.0 / 6);
        Eight3 last{Eight{}, Eight{}, Eight{}};
        for (std::size_t k = 0; k < 6; ++k) {
            const Eight3 side = x[corner(k)].cross(x[corner(k + 1)]);
            const Eight six_volumes = side.dot(diagonal);
            least = k == 0 || six_volumes < least ? six_volumes : least;
            last = last + side;
            gradient[corner(k)] = (x[corner(k + 1)] - x[corner(k + 5)]).cross(diagonal) * sixth;
        }
        gradient[6] = last * sixth;
        volume = gradient[6].dot(diagonal);
    }
};

/// What a step does to cells: mean strain and spin, and how they bend and twist.
struct CellMotion {
    SixEights strain;
    Eight3 half_spin;
    Warps warp; ///< eq. (10) of docs/theory/zones.md

    [[gnu::always_inline]] CellMotion(const CellShape& shape, const CellField& shift) {
        const Eight over = 1.0 / shape.volume;
        const auto row = [&](auto component) { // of the mean gradient: of one component of the motion
            Eight3 sum = shape.gradient[0] * component(shift[0]);
            for (std::size_t c = 1; c < 7; ++c) sum = sum + shape.gradient[c] * component(shift[c]);
            return sum * over;
        };
        const Eight3 x = row([](const Eight3&v) { return v.x; }), y = row([](const Eight3&v) { return v.y; }),
                     z = row([](const Eight3&v) { return v.z; });
        strain = {x.x, y.y, z.z, 0.5 * (x.y + y.x), 0.5 * (x.z + z.x), 0.5 * (y.z + z.y)};
        half_spin = {0.25 * (z.y - y.z), 0.25 * (x.z - z.x), 0.25 * (y.x - x.y)};
        const Warps whole = CornerSums(shift).warp;
        for (std::size_t h = 0; h < 4; ++h) {
            const Eight3& place = shape.warp[h];
            warp[h] = (whole[h] - Eight3{x.dot(place), y.dot(place), z.dot(place)}) * eights(0.125);
        }
    }
};

/// How cells resist warping: numbers that turn with the cell. For each axis the stress of its layers at the end of the axis, as
/// bb, cc and bc of the other two axes; then the stress along each axis for the product of all three.
using WarpStress = std::array<Eight, 12>;

/// The warp stresses of cells whose zones follow each other from one on.
inline WarpStress load_warps(const Zones& zones, std::size_t column, Row first, Row cells) {
    const SixEights low = load_six(&zones.history[column][first], 6, cells),
                    high = load_six(&zones.history[column + 1][first], 6, cells);
    WarpStress stress;
    std::copy(low.begin(), low.end(), stress.begin());
    std::copy(high.begin(), high.end(), stress.begin() + 6);
    return stress;
}
inline void store_warps(Zones& zones, std::size_t column, Row first, Row cells, const WarpStress& s) {
    store_six(&zones.history[column][first], 6, cells, {s[0], s[1], s[2], s[3], s[4], s[5]});
    store_six(&zones.history[column + 1][first], 6, cells, {s[6], s[7], s[8], s[9], s[10], s[11]});
}

/// Moduli of layers under no pressure from one to the next, and of fibres.
struct LayerModuli {
    double lambda = 0, two_shear = 0, young = 0;

    LayerModuli() = default; ///< nothing resists
    LayerModuli(double of_volume, double twice_shear) : two_shear(twice_shear) {
        const double whole = of_volume + twice_shear;
        if (!(twice_shear > 0) || !(whole > 0)) return;
        lambda = of_volume * twice_shear / whole;
        young = 0.5 * twice_shear * (3 * of_volume + twice_shear) / (of_volume + 0.5 * twice_shear);
    }
};

/// What the warps `g` of a step add to the stress. Returns the work of the step, by cell.
[[gnu::always_inline]] inline Eight add_warp_stress(const CellShape& shape, const Warps& g, const LayerModuli& moduli,
                                                    WarpStress& stress) {
    const Eight lambda = eights(moduli.lambda), two_shear = eights(moduli.two_shear);
    std::array<Eight, 3> square, product; // of the axes: of one with itself, and of the two others
    for (std::size_t a = 0; a < 3; ++a) {
        square[a] = shape.axis[a].dot(shape.axis[a]);
        product[a] = shape.axis[(a + 1) % 3].dot(shape.axis[(a + 2) % 3]);
    }
    Eight layers{}, fibres{};
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
        const Eight3 &jb = shape.axis[b], &jc = shape.axis[c];
        const Eight bb = jb.dot(g[c]), cc = jc.dot(g[b]), bc = 0.5 * (jb.dot(g[b]) + jc.dot(g[c]));
        const Eight &mb = square[b], &mc = square[c], &m = product[a], r = 1.0 / (mb * mc - m * m);
        const Eight ib = mc * r, ic = mb * r, i = -m * r; // inverse of the metric
        const Eight trace = lambda * (ib * bb + ic * cc + 2.0 * i * bc);
        const std::array<Eight, 3> change{ib * trace + two_shear * (ib * ib * bb + 2.0 * ib * i * bc + i * i * cc),
                                          ic * trace + two_shear * (ic * ic * cc + 2.0 * ic * i * bc + i * i * bb),
                                          i * trace + two_shear * (ib * i * bb + (ib * ic + i * i) * bc + ic * i * cc)};
        Eight* const s = &stress[3 * a];
        layers += (s[0] + 0.5 * change[0]) * bb + (s[1] + 0.5 * change[1]) * cc + (2.0 * s[2] + change[2]) * bc;
        for (std::size_t k = 0; k < 3; ++k) s[k] += change[k];
        const Eight along = shape.axis[a].dot(g[3]) / square[a], more = moduli.young * along;
        fibres += (stress[9 + a] + 0.5 * more) * along;
        stress[9 + a] += more;
    }
    // Means over the cell of the squares of one axis, and of a product of two.
    return shape.volume * (layers * (1.0 / 3) + fibres * (1.0 / 9));
}

/// Forces on the corners 0 to 7 of cells whose zones all have the same stress, and which are warped.
[[gnu::always_inline]] inline CellForces forces_of(const CellShape& shape, const SixEights& stress,
                                                   const WarpStress& warped) {
    Warps force;
    force.fill({Eight{}, Eight{}, Eight{}});
    const Eight third = shape.volume * (-1.0 / 24), ninth = shape.volume * (-1.0 / 72); // and 1/8 of the coefficients
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
        const Eight* const s = &warped[3 * a];
        const Eight3 &ja = shape.axis[a], &jb = shape.axis[b], &jc = shape.axis[c];
        force[c] = force[c] + (jb * s[0] + jc * s[2]) * third;
        force[b] = force[b] + (jc * s[1] + jb * s[2]) * third;
        force[3] = force[3] + ja * (warped[9 + a] * ninth / ja.dot(ja));
    }
    // A linear field has no warp: the mean gradient takes its part away.
    const Eight over = 1.0 / shape.volume;
    std::array<Eight3, 3> tensor{Eight3{stress[0], stress[3], stress[4]}, Eight3{stress[3], stress[1], stress[5]},
                                 Eight3{stress[4], stress[5], stress[2]}};
    for (std::size_t h = 0; h < 4; ++h) {
        const Eight3 place = shape.warp[h] * over;
        tensor[0] = tensor[0] + place * force[h].x;
        tensor[1] = tensor[1] + place * force[h].y;
        tensor[2] = tensor[2] + place * force[h].z;
    }
    const Eight3 plus = force[0] + force[1], minus = force[0] - force[1], high = force[2] + force[3],
                 low = force[2] - force[3], none{Eight{}, Eight{}, Eight{}};
    CellForces f{none,        minus - low,           none - (minus + low), low - plus,
                 high - plus, none - (minus + high), minus - high,         plus + high};
    for (std::size_t c = 1; c < 8; ++c) {
        const Eight3& g = shape.gradient[c - 1];
        f[c] = f[c] - Eight3{tensor[0].dot(g), tensor[1].dot(g), tensor[2].dot(g)};
        f[0] = f[0] - f[c];
    }
    return f;
}

} // namespace kaya
