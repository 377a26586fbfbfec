// Linear tetrahedra, eight at a time: shape, deformation in a step, and the forces of a stress on the corners.
#pragma once

#include "mechanics/lanes/eight.hpp"
#include "mechanics/zones/zone_tiles.hpp"

#include <algorithm>
#include <array>

namespace kaya {

/// Zones are processed eight at a time, one in each lane.
using ZoneGroup = const ZoneCorners*; ///< the corners of eight zones that follow each other

struct EightRow {
    Eight3 vector;
    Eight fourth;
};

/// Rows of the points that are corner `a` of the zones.
inline EightRow load_corner(const PointRow* rows, ZoneGroup zones, std::size_t a) {
    std::array<Four, 8> r;
    for (std::size_t l = 0; l < 8; ++l) r[l] = load_as<Four>(rows[zones[l][a]].value.data());
    const std::array<Eight, 4> c = columns_of_rows(r);
    return {{c[0], c[1], c[2]}, c[3]};
}

/// The opposite: adds to the rows of the points, four zones after four, and of these corner after corner.
[[gnu::always_inline]] inline void add_to_corners(PointRow* rows, ZoneGroup zones, Row count,
                                                  const std::array<Eight3, 4>& vector,
                                                  const std::array<Eight, 4>& fourth) {
    const auto add = [&](std::size_t first, const auto& half) {
        for (std::size_t a = 0; a < 4; ++a) {
            std::array<Four, 4> r{half(vector[a].x), half(vector[a].y), half(vector[a].z), half(fourth[a])};
            transpose(r);
            const std::size_t here = std::min<std::size_t>(static_cast<std::size_t>(count) - first, 4);
            for (std::size_t l = 0; l < here; ++l) {
                double* const row = rows[zones[first + l][a]].value.data();
                store(row, Four(load_as<Four>(row) + r[l]));
            }
        }
    };
    add(0, low_half);
    if (count > 4) add(4, high_half);
}

/// The mean over the corners of the fourth number of the points.
inline Eight mean_of_fourth(const PointRow* rows, ZoneGroup zones) {
    Eight sum = load_corner(rows, zones, 0).fourth;
    for (std::size_t a = 1; a < 4; ++a) sum += load_corner(rows, zones, a).fourth;
    return 0.25 * sum;
}

/// From the first corner to the others.
using Edges = std::array<Eight3, 3>;

[[gnu::always_inline]] inline Edges edges_of(const PointRow* rows, ZoneGroup zones) {
    const Eight3 first = load_corner(rows, zones, 0).vector;
    Edges edges;
    for (std::size_t i = 0; i < 3; ++i) edges[i] = load_corner(rows, zones, i + 1).vector - first;
    return edges;
}

/// Twice the area vectors of the faces opposite to corners 1 to 3, inwards. Over six volumes they are the gradients of the shape
/// functions.
struct FaceAreas {
    std::array<Eight3, 3> twice_area;
    Eight six_volumes;

    explicit FaceAreas(const Edges& e)
        : twice_area{e[1].cross(e[2]), e[2].cross(e[0]), e[0].cross(e[1])}, six_volumes(e[0].dot(twice_area[0])) {}
};

/// Components xx, yy, zz, xy, xz, yz.
using SixEights = std::array<Eight, 6>;

inline Eight mean_of_three(const SixEights& stress) { return (stress[0] + stress[1] + stress[2]) * (1.0 / 3); }

/// Edges in the middle of a step, from those at its end and their change in it; with `large` they were shorter by that change before.
[[gnu::always_inline]] inline Edges middle_of(Edges edges, const Edges& shift, bool large) {
    if (large)
        for (std::size_t i = 0; i < 3; ++i) edges[i] = edges[i] - shift[i] * eights(0.5);
    return edges;
}

/// Volume and volume strain, as in Deformation, for less work.
struct VolumeStrain {
    Eight volume, volume_strain;

    [[gnu::always_inline]] VolumeStrain(const Edges& edges, const Edges& shift, bool large) {
        const FaceAreas faces(middle_of(edges, shift, large));
        const auto& c = faces.twice_area;
        volume = faces.six_volumes * (1.0 / 6);
        volume_strain = (c[0].dot(shift[0]) + c[1].dot(shift[1]) + c[2].dot(shift[2])) / faces.six_volumes;
    }
};

/// Deformation of tetrahedra in a step: gradient of the motion with respect to the configuration at mid-step, where a rigid rotation gives
/// no strain (Hughes and Winget 1980, Int. J. Numer. Meth. Eng. 15).
struct Deformation {
    Eight volume, volume_strain;
    SixEights strain;
    Eight3 half_spin; ///< axial vector of half the skew part

    [[gnu::always_inline]] Deformation(const Edges& edges, const Edges& shift, bool large) {
        const FaceAreas faces(middle_of(edges, shift, large));
        const Eight over = 1.0 / faces.six_volumes;
        const auto& c = faces.twice_area;
        const auto row = [&](auto component) { // of the gradient: of one component of the motion
            return (c[0] * component(shift[0]) + c[1] * component(shift[1]) + c[2] * component(shift[2])) * over;
        };
        const Eight3 x = row([](const Eight3&v) { return v.x; }), y = row([](const Eight3&v) { return v.y; }),
                     z = row([](const Eight3&v) { return v.z; });
        volume = faces.six_volumes * (1.0 / 6);
        volume_strain = x.x + y.y + z.z;
        strain = {x.x, y.y, z.z, 0.5 * (x.y + y.x), 0.5 * (x.z + z.x), 0.5 * (y.z + z.y)};
        half_spin = {0.25 * (z.y - y.z), 0.25 * (x.z - z.x), 0.25 * (y.x - x.y)};
    }
};

/// A stress that turns with the material: Q stress Q^T with Q = (I - W/2)^-1 (I + W/2), where W/2 has the axial vector given.
[[gnu::always_inline]] inline SixEights turned(const SixEights& s, const Eight3& h) {
    const Eight size = h.dot(h), r = 2.0 / (1.0 + size), rest = 1.0 - r * size;
    const Eight rx = r * h.x, ry = r * h.y, rz = r * h.z, xy = rx * h.y, xz = rx * h.z, yz = ry * h.z;
    const std::array<Eight3, 3> q{Eight3{rest + rx * h.x, xy - rz, xz + ry}, Eight3{xy + rz, rest + ry * h.y, yz - rx},
                                  Eight3{xz - ry, yz + rx, rest + rz * h.z}};
    const Eight3 s0{s[0], s[3], s[4]}, s1{s[3], s[1], s[5]}, s2{s[4], s[5], s[2]};
    std::array<Eight3, 3> t;
    for (std::size_t i = 0; i < 3; ++i) t[i] = {q[i].dot(s0), q[i].dot(s1), q[i].dot(s2)};
    return {t[0].dot(q[0]), t[1].dot(q[1]), t[2].dot(q[2]), t[0].dot(q[1]), t[0].dot(q[2]), t[1].dot(q[2])};
}

/// The spin of a step, in the columns of a batch from row `i` on.
template <class Columns> void store_spin(Columns& columns, Row i, const Eight3& half_spin) {
    store(columns.spin[0] + i, 2.0 * half_spin.x);
    store(columns.spin[1] + i, 2.0 * half_spin.y);
    store(columns.spin[2] + i, 2.0 * half_spin.z);
}

/// Forces of a stress on the corners of tetrahedra, in the configuration of `edges`.
[[gnu::always_inline]] inline std::array<Eight3, 4> forces_of(const Edges& edges, const SixEights& stress) {
    const FaceAreas faces(edges);
    const Eight part = eights(-1.0 / 6);
    const Eight3 s0 = Eight3{stress[0], stress[3], stress[4]} * part,
                 s1 = Eight3{stress[3], stress[1], stress[5]} * part,
                 s2 = Eight3{stress[4], stress[5], stress[2]} * part;
    std::array<Eight3, 4> force;
    for (std::size_t i = 0; i < 3; ++i) {
        const Eight3& c = faces.twice_area[i];
        force[i + 1] = {s0.dot(c), s1.dot(c), s2.dot(c)};
    }
    force[0] = (force[1] + force[2] + force[3]) * eights(-1);
    return force;
}

} // namespace kaya
