// Linear tetrahedra, four at a time: shape, what a step does to it, and the forces of a stress on the corners.
#pragma once

#include "mechanics/zone_tiles.hpp"
#include "model/lanes.hpp"

#include <array>

namespace kaya {

/// Zones go four at a time, one in each lane.
using ZoneGroup = const std::array<Row, 4>*; ///< the corners of four zones that follow each other, as points of a tile

struct LanesRow {
    Lanes3 vector;
    Lanes fourth;
};

/// Four rows, or the same numbers as four columns of them.
using Four [[gnu::vector_size(32)]] = double;
inline void transpose(std::array<Four, 4>& r) {
    const Four xz01 = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6), xz23 = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6);
    const Four yw01 = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7), yw23 = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
    r = {__builtin_shufflevector(xz01, xz23, 0, 1, 4, 5), __builtin_shufflevector(yw01, yw23, 0, 1, 4, 5),
         __builtin_shufflevector(xz01, xz23, 2, 3, 6, 7), __builtin_shufflevector(yw01, yw23, 2, 3, 6, 7)};
}
inline void load(Four& four, const double* from) { __builtin_memcpy(&four, from, sizeof four); }
inline void store(double* to, const Four& four) { __builtin_memcpy(to, &four, sizeof four); }

/// Rows of the points that are corner `a` of the zones.
inline LanesRow load_corner(const PointRow* rows, ZoneGroup zones, std::size_t a) {
    std::array<Four, 4> r;
    for (std::size_t l = 0; l < 4; ++l) load(r[l], rows[zones[l][a]].value.data());
    transpose(r);
    LanesRow out;
    store(out.vector.x.data(), r[0]);
    store(out.vector.y.data(), r[1]);
    store(out.vector.z.data(), r[2]);
    store(out.fourth.data(), r[3]);
    return out;
}

/// The opposite: adds to the rows of the points, zone after zone.
inline void add_to_corner(PointRow* rows, ZoneGroup zones, Row count, std::size_t a, const Lanes3& vector, const Lanes& fourth) {
    std::array<Four, 4> r;
    load(r[0], vector.x.data());
    load(r[1], vector.y.data());
    load(r[2], vector.z.data());
    load(r[3], fourth.data());
    transpose(r);
    for (Row l = 0; l < count; ++l) {
        double* const row = rows[zones[l][a]].value.data();
        Four sum;
        load(sum, row);
        store(row, sum + r[static_cast<std::size_t>(l)]);
    }
}

/// The mean over the corners of what goes with the points.
inline Lanes mean_of_fourth(const PointRow* rows, ZoneGroup zones) {
    Lanes sum = load_corner(rows, zones, 0).fourth;
    for (std::size_t a = 1; a < 4; ++a) sum += load_corner(rows, zones, a).fourth;
    return 0.25 * sum;
}

/// From the first corner to the others.
using Edges = std::array<Lanes3, 3>;

inline Edges edges_of(const PointRow* rows, ZoneGroup zones) {
    const Lanes3 first = load_corner(rows, zones, 0).vector;
    Edges edges;
    for (std::size_t i = 0; i < 3; ++i) edges[i] = load_corner(rows, zones, i + 1).vector - first;
    return edges;
}

/// Twice the area vectors of the faces opposite to corners 1 to 3, inwards. Over six volumes they are the gradients of the shape
/// functions.
struct FaceAreas {
    std::array<Lanes3, 3> twice_area;
    Lanes six_volumes;

    explicit FaceAreas(const Edges& e)
        : twice_area{e[1].cross(e[2]), e[2].cross(e[0]), e[0].cross(e[1])}, six_volumes(e[0].dot(twice_area[0])) {}
};

/// Components xx, yy, zz, xy, xz, yz.
using SixLanes = std::array<Lanes, 6>;

/// What a step does to tetrahedra: gradient of the motion with respect to the configuration in its middle, where a rigid turn
/// gives no strain (Hughes and Winget 1980, Int. J. Numer. Meth. Eng. 15).
struct Deformation {
    Lanes volume, volume_strain;
    SixLanes strain;
    Lanes3 half_spin; ///< axial vector of half the skew part

    /// `edges` at the end of the step, `way`: by how much they have changed; with `large` they were shorter by that before.
    Deformation(const Edges& edges, const Edges& shift, bool large) {
        Edges middle = edges;
        if (large)
            for (std::size_t i = 0; i < 3; ++i) middle[i] = edges[i] - shift[i] * Lanes::Constant(0.5);
        const FaceAreas faces(middle);
        const Lanes over = 1.0 / faces.six_volumes;
        const auto& c = faces.twice_area;
        const auto row = [&](auto component) { // of the gradient: of one component of the motion
            return (c[0] * component(shift[0]) + c[1] * component(shift[1]) + c[2] * component(shift[2])) * over;
        };
        const Lanes3 x = row([](const Lanes3& v) { return v.x; }), y = row([](const Lanes3& v) { return v.y; }),
                     z = row([](const Lanes3& v) { return v.z; });
        volume = faces.six_volumes * (1.0 / 6);
        volume_strain = x.x + y.y + z.z;
        strain = {x.x, y.y, z.z, 0.5 * (x.y + y.x), 0.5 * (x.z + z.x), 0.5 * (y.z + z.y)};
        half_spin = {0.25 * (z.y - y.z), 0.25 * (x.z - z.x), 0.25 * (y.x - x.y)};
    }
};

/// A stress that turns with the material: Q stress Q^T with Q = (I - W/2)^-1 (I + W/2), where W/2 has the axial vector given.
[[gnu::always_inline]] inline SixLanes turned(const SixLanes& s, const Lanes3& h) {
    const Lanes size = h.dot(h), r = 2.0 / (1.0 + size), rest = 1.0 - r * size;
    const Lanes rx = r * h.x, ry = r * h.y, rz = r * h.z, xy = rx * h.y, xz = rx * h.z, yz = ry * h.z;
    const std::array<Lanes3, 3> q{Lanes3{rest + rx * h.x, xy - rz, xz + ry}, Lanes3{xy + rz, rest + ry * h.y, yz - rx},
                                  Lanes3{xz - ry, yz + rx, rest + rz * h.z}};
    const Lanes3 s0{s[0], s[3], s[4]}, s1{s[3], s[1], s[5]}, s2{s[4], s[5], s[2]};
    std::array<Lanes3, 3> t;
    for (std::size_t i = 0; i < 3; ++i) t[i] = {q[i].dot(s0), q[i].dot(s1), q[i].dot(s2)};
    return {t[0].dot(q[0]), t[1].dot(q[1]), t[2].dot(q[2]), t[0].dot(q[1]), t[0].dot(q[2]), t[1].dot(q[2])};
}

/// Forces of a stress on the corners of tetrahedra, in the configuration of `edges`.
inline std::array<Lanes3, 4> forces_of(const Edges& edges, const SixLanes& stress) {
    const FaceAreas faces(edges);
    const Lanes part = Lanes::Constant(-1.0 / 6);
    const Lanes3 s0 = Lanes3{stress[0], stress[3], stress[4]} * part, s1 = Lanes3{stress[3], stress[1], stress[5]} * part,
                 s2 = Lanes3{stress[4], stress[5], stress[2]} * part;
    std::array<Lanes3, 4> force;
    for (std::size_t i = 0; i < 3; ++i) {
        const Lanes3& c = faces.twice_area[i];
        force[i + 1] = {s0.dot(c), s1.dot(c), s2.dot(c)};
    }
    force[0] = (force[1] + force[2] + force[3]) * Lanes::Constant(-1);
    return force;
}

} // namespace kaya
