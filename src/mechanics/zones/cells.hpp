// Cells of six zones that bend and twist as hexahedra do, eight at a time: docs/theory/zones.md.
#pragma once

#include "mechanics/zones/tile_rows.hpp"

#include <algorithm>
#include <array>

namespace kaya {

constexpr std::size_t to_next_cell = 6 * zones_of_cell; ///< distance of the stresses of consecutive cells, in numbers

/// The number of cells from `zone` on, at most eight.
inline Row cells_from(Row zone, Row last) { return std::min<Row>((last - zone) / zones_of_cell, eight); }

/// A field at corners 1 to 7 of eight cells, relative to corner 0: a constant field is exactly zero, without rounding.
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

/// Corners 1 to 7 relative to corner 0. The fourth number of each point goes to `fourths`, if given, by corner.
inline CellField from_first(const PointRow* rows, CellGroupCorners corners, std::array<Eight, 8>* fourths = nullptr) {
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

/// Products of the components of stresses and strains.
inline Eight product(const SixEights& stress, const SixEights& strain) {
    return stress[0] * strain[0] + stress[1] * strain[1] + stress[2] * strain[2] +
           2.0 * (stress[3] * strain[3] + stress[4] * strain[4] + stress[5] * strain[5]);
}
inline SixEights sum(const SixEights& a, const SixEights& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]};
}

inline SixEights difference(const SixEights& a, const SixEights& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] - b[4], a[5] - b[5]};
}

/// The nonlinear part of a field: under each axis number the product of the two other axes, then the product of all three.
using Warps = std::array<Eight3, 4>;

/// Sums of a field over the corners, with the signs of the corners along the axes and the products of these signs.
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

/// The faces of cells that are ruled surfaces instead of two triangles: those at corner 0 by the number of the axis across them, then those
/// at corner 7.
struct RuledFaces {
    std::array<Eight, 6> part; ///< a twelfth for a face that is ruled, else 0
    bool any = false;

    /// `faces` has a bit for each face of a cell.
    [[gnu::always_inline]] explicit RuledFaces(const std::uint8_t* faces) {
        MaskOfEight bits{};
        for (std::size_t l = 0; l < eight; ++l) any |= (bits[l] = faces[l]) != 0;
        for (std::size_t f = 0; f < 6; ++f) part[f] = (bits & (1 << f)) != 0 ? eights(1.0 / 12) : Eight{};
    }
};

/// Products of positions. All zones share the edge from corner 0 to corner 7; the other corners follow each other around it.
struct AroundDiagonal {
    std::array<Eight3, 6> side;  ///< of those two, in their order around the edge
    std::array<Eight3, 6> spoke; ///< of each corner and corner 7; by corner, from 1 on

    [[gnu::always_inline]] explicit AroundDiagonal(const CellField& x) {
        for (std::size_t k = 0; k < 6; ++k) {
            side[k] = x[corner(k)].cross(x[corner(k + 1)]);
            spoke[corner(k)] = x[corner(k)].cross(x[6]);
        }
    }

    /// Indices in fields of the corners around the edge.
    static constexpr std::size_t corner(std::size_t k) { return std::array<std::size_t, 6>{0, 2, 1, 5, 3, 4}[k % 6]; }
};

/// Shape of cells in one configuration. Volume and gradient are those between the faces of the cell.
struct CellShape {
    std::array<Eight3, 3> axis; ///< halves of the mean edges
    CellField
        gradient; ///< of the mean of a field over the cell, times the volume: how the volume changes with a corner
    Warps warp;   ///< of the places of the corners
    Eight volume, least; ///< least: six times the volume of the smallest zone

    CellShape() = default;
    [[gnu::always_inline]] CellShape(const CellField& x, const RuledFaces& ruled) {
        const CornerSums sums(x);
        for (std::size_t a = 0; a < 3; ++a) axis[a] = sums.axis[a] * eights(0.125);
        warp = sums.warp;
        const AroundDiagonal around(x);
        Eight3 last{Eight{}, Eight{}, Eight{}};
        for (std::size_t k = 0; k < 6; ++k) {
            const Eight six_volumes = around.side[k].dot(x[6]);
            least = k == 0 || six_volumes < least ? six_volumes : least;
            last = last + around.side[k];
        }
        const Eight sixth = eights(1.0 / 6);
        for (std::size_t k = 0; k < 6; ++k)
            gradient[around.corner(k)] =
                (around.spoke[around.corner(k + 1)] - around.spoke[around.corner(k + 5)]) * sixth;
        gradient[6] = last * sixth;
        if (ruled.any) add_ruled(x, around, ruled, gradient);
        volume = gradient[0].x * x[0].x;
        for (std::size_t c = 1; c < 7; ++c) volume += gradient[c].x * x[c].x;
    }

private:
    /// The ruled surface of four corners is halfway between the pairs of triangles of its two diagonals; the tetrahedron of the corners
    /// lies between them. A face has corner 0 or 7; b and c are the corners next to it, `far` is the opposite one.
    [[gnu::always_inline]] static void add_ruled(const CellField& x, const AroundDiagonal& around,
                                                 const RuledFaces& ruled, CellField& gradient) {
        const auto& [side, spoke] = around;
        const auto add = [&](std::size_t corner, const Eight3& area) { gradient[corner] = gradient[corner] + area; };
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t b = (std::size_t{1} << (a + 1) % 3) - 1, c = (std::size_t{1} << (a + 2) % 3) - 1;
            const Eight& part = ruled.part[a];
            add(b + c + 1, x[b].cross(x[c]) * part);
            add(c, side[(2 * a + 2) % 6] * -part);
            add(b, side[(2 * a + 3) % 6] * -part);
        }
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t far = (std::size_t{1} << a) - 1, b = 6 - (std::size_t{1} << (a + 2) % 3),
                              c = 6 - (std::size_t{1} << (a + 1) % 3);
            const Eight& part = ruled.part[3 + a];
            const Eight3 &next = side[(2 * a + 5) % 6], &before = side[2 * a], across = x[b].cross(x[c]);
            add(b, (next - spoke[c] + spoke[far]) * part);
            add(c, (before - spoke[far] + spoke[b]) * part);
            add(far, (across - spoke[b] + spoke[c]) * part);
            add(6, (next + before + across) * -part);
        }
    }
};

/// Throws where a zone has no volume left. `place` as in the shape.
inline void check_cells(const Model& model, Row zone, Row cells, const CellField& place, const CellShape& shape) {
    if (all_above_zero(shape.least)) return;
    for (Row z = 0; z < zones_of_cell; ++z)
        check_volumes(model, zone + z, zones_of_cell, cells, FaceAreas(edges_of_zone(place, z)).six_volumes);
}

/// Mean gradient of a motion, by component of the motion.
struct MeanGradient {
    Eight3 x, y, z;

    /// `gradient` as in CellShape.
    [[gnu::always_inline]] MeanGradient(const CellField& gradient, const CellField& shift, const Eight& over_volume) {
        const auto row = [&](auto component) {
            Eight3 sum = gradient[0] * component(shift[0]);
            for (std::size_t c = 1; c < 7; ++c) sum = sum + gradient[c] * component(shift[c]);
            return sum * over_volume;
        };
        x = row([](const Eight3& v) { return v.x; });
        y = row([](const Eight3& v) { return v.y; });
        z = row([](const Eight3& v) { return v.z; });
    }

    /// The gradient with respect to the configuration half a step earlier, G (1 - G/2)^-1. Returns the volume there over the present one.
    [[gnu::always_inline]] Eight go_to_middle() {
        const Eight half = eights(-0.5), one = eights(1);
        const Eight3 r0{one + half * x.x, half * x.y, half * x.z}, r1{half * y.x, one + half * y.y, half * y.z},
            r2{half * z.x, half * z.y, one + half * z.z};
        const Eight3 c0 = r1.cross(r2), c1 = r2.cross(r0), c2 = r0.cross(r1);
        const Eight whole = r0.dot(c0), over = 1.0 / whole;
        for (Eight3* row : {&x, &y, &z}) *row = Eight3{row->dot(c0), row->dot(c1), row->dot(c2)} * over;
        return whole;
    }

    SixEights strain() const { return {x.x, y.y, z.z, 0.5 * (x.y + y.x), 0.5 * (x.z + z.x), 0.5 * (y.z + z.y)}; }
};

/// Motion of cells in a step: mean strain and spin, bending and twisting.
struct CellMotion {
    SixEights strain;
    Eight3 half_spin;
    Warps warp; ///< eq. (10) of docs/theory/zones.md
    std::array<Eight3, 3>
        axis;     ///< as in CellShape, and the volume, of the configuration in which the step strains: with `large` its
    Eight volume; ///< middle, else the one that stays

    /// `shape` at the end of the step.
    [[gnu::always_inline]] CellMotion(const CellShape& shape, const CellField& shift, bool large)
        : axis(shape.axis), volume(shape.volume) {
        MeanGradient mean(shape.gradient, shift, 1.0 / shape.volume);
        const CornerSums sums(shift);
        for (std::size_t h = 0; h < 4; ++h) {
            const Eight3& place = shape.warp[h];
            warp[h] = (sums.warp[h] - Eight3{mean.x.dot(place), mean.y.dot(place), mean.z.dot(place)}) * eights(0.125);
        }
        if (large) {
            volume *= mean.go_to_middle();
            for (std::size_t a = 0; a < 3; ++a) axis[a] = axis[a] - sums.axis[a] * eights(0.0625);
        }
        strain = mean.strain();
        half_spin = {0.25 * (mean.z.y - mean.y.z), 0.25 * (mean.x.z - mean.z.x), 0.25 * (mean.y.x - mean.x.y)};
    }
};

/// Resistance of cells to warping: numbers that turn with the cell. For each axis the stress of its layers at the end of the axis, as bb,
/// cc and bc of the other two axes; then the stress along each axis for the product of all three.
using WarpStress = std::array<Eight, 12>;

/// The warp stresses of consecutive cells, starting at `first`: in columns of Zones.
using WarpColumns = std::array<Column<double>, 2>;
[[gnu::always_inline]] inline void load_warps(const WarpColumns& columns, Row first, Row cells, WarpStress& stress) {
    for (std::size_t half = 0; half < 2; ++half) {
        const SixEights six = load_six(&columns[half][first], 6, cells);
        for (std::size_t k = 0; k < 6; ++k) stress[6 * half + k] = six[k];
    }
}
[[gnu::always_inline]] inline void store_warps(WarpColumns& columns, Row first, Row cells, const WarpStress& s) {
    store_six(&columns[0][first], 6, cells, {s[0], s[1], s[2], s[3], s[4], s[5]});
    store_six(&columns[1][first], 6, cells, {s[6], s[7], s[8], s[9], s[10], s[11]});
}

/// Moduli of layers without pressure between them, and of fibres.
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

/// The stress of a layer in its plane, without pressure from layer to layer.
struct LayerStress {
    Eight bb, cc, bc;

    /// `bb`, `cc` and `bc` of the strain along the halves b and c of the mean edges, whose squares are mb and mc, and their product m.
    [[gnu::always_inline]] LayerStress(const LayerModuli& moduli, const Eight& mb, const Eight& mc, const Eight& m,
                                       const Eight& bb, const Eight& cc, const Eight& bc) {
        const Eight lambda = eights(moduli.lambda), two_shear = eights(moduli.two_shear), r = 1.0 / (mb * mc - m * m);
        const Eight ib = mc * r, ic = mb * r, i = -m * r; // inverse of the metric
        const Eight trace = lambda * (ib * bb + ic * cc + 2.0 * i * bc);
        this->bb = ib * trace + two_shear * (ib * ib * bb + 2.0 * ib * i * bc + i * i * cc);
        this->cc = ic * trace + two_shear * (ic * ic * cc + 2.0 * ic * i * bc + i * i * bb);
        this->bc = i * trace + two_shear * (ib * i * bb + (ib * ic + i * i) * bc + ic * i * cc);
    }
};

/// Warps of a step as strains, in the order of WarpStress.
struct WarpStep {
    WarpStress strain;

    WarpStep() = default;
    [[gnu::always_inline]] explicit WarpStep(const CellMotion& step) {
        const Warps& g = step.warp;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
            const Eight3 &ja = step.axis[a], &jb = step.axis[b], &jc = step.axis[c];
            strain[3 * a] = jb.dot(g[c]), strain[3 * a + 1] = jc.dot(g[b]);
            strain[3 * a + 2] = 0.5 * (jb.dot(g[b]) + jc.dot(g[c]));
            strain[9 + a] = ja.dot(g[3]) / ja.dot(ja);
        }
    }

    /// Elastic changes of stress of layers without pressure between them, and of fibres.
    [[gnu::always_inline]] WarpStress elastic(const CellMotion& step, const LayerModuli& moduli) const {
        std::array<Eight, 3> square, product; // of the axes: of one with itself, and of the two others
        for (std::size_t a = 0; a < 3; ++a) {
            square[a] = step.axis[a].dot(step.axis[a]);
            product[a] = step.axis[(a + 1) % 3].dot(step.axis[(a + 2) % 3]);
        }
        WarpStress change;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t b = (a + 1) % 3, c = (a + 2) % 3, k = 3 * a;
            const LayerStress layer(moduli, square[b], square[c], product[a], strain[k], strain[k + 1], strain[k + 2]);
            change[k] = layer.bb, change[k + 1] = layer.cc, change[k + 2] = layer.bc;
            change[9 + a] = moduli.young * strain[9 + a];
        }
        return change;
    }

    /// Work of the step against a stress, by cell: means over the cell of the squares of one axis, and of a product of two. `volume` is that
    /// of the step.
    [[gnu::always_inline]] Eight work(const Eight& volume, const WarpStress& s) const {
        Eight layers{}, fibres{};
        for (std::size_t a = 0; a < 9; a += 3)
            layers += s[a] * strain[a] + s[a + 1] * strain[a + 1] + 2.0 * s[a + 2] * strain[a + 2];
        for (std::size_t a = 9; a < 12; ++a) fibres += s[a] * strain[a];
        return volume * (layers * (1.0 / 3) + fibres * (1.0 / 9));
    }
};

/// a + factor * b
[[gnu::always_inline]] inline WarpStress added(const WarpStress& a, double factor, const WarpStress& b) {
    WarpStress sum;
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = a[k] + factor * b[k];
    return sum;
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
    // A linear field has no warp: the contribution of the mean gradient is subtracted.
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
    CellForces f;
    f[1] = minus - low;
    f[2] = none - (minus + low);
    f[3] = low - plus;
    f[4] = high - plus;
    f[5] = none - (minus + high);
    f[6] = minus - high;
    f[7] = plus + high;
    Eight3 first = none;
    for (std::size_t c = 1; c < 8; ++c) {
        const Eight3& g = shape.gradient[c - 1];
        f[c] = f[c] - Eight3{tensor[0].dot(g), tensor[1].dot(g), tensor[2].dot(g)};
        first = first - f[c];
    }
    f[0] = first;
    return f;
}

inline CellForces both(const CellForces& a, const CellForces& b) {
    CellForces forces;
    for (std::size_t c = 0; c < 8; ++c) forces[c] = a[c] + b[c];
    return forces;
}

} // namespace kaya
