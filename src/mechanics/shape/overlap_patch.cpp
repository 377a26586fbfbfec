#include "mechanics/shape/overlap_patch.hpp"

#include "mechanics/shape/face_corners.hpp"
#include "mechanics/shape/overlap_scratch.hpp"
#include "mechanics/shape/surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace kaya {

namespace {

/// The contribution of one block to a clip.
struct Side {
    Row block;
    double sense; ///< +1: its outward normals point along the contact's normal
};

/// A closing offset moves block 1 along its direction, or block 2 against it.
Vec3 shift(const Side& side, const Vec3& x, const ClosureOffset& offset, const Vec3& offset_origin) {
    return side.sense * (offset.closure + offset.tilt.dot(x - offset_origin)) * offset.along;
}

/// The half space of a face of the polyhedron to be clipped.
HalfSpace half_space_of(const ConvexClip& clip, std::size_t face) {
    const Vec3 outward = clip.area_vector(face).normalized();
    return {outward, outward.dot(clip.corner(face, 0))};
}

void add_subject(const Model& model, const Side& side, const Vec3& origin, const ClosureOffset& offset,
                 const Vec3& offset_origin, OverlapScratch& work) {
    const Span points = model.blocks.gridpoints[side.block];
    const bool shifted = offset.closure != 0 || !offset.tilt.isZero(0);
    for (Row g = points.first; g < points.end(); ++g) {
        const Vec3& x = model.gridpoints.position[g];
        work.clip.add_vertex(shifted ? Vec3(x + shift(side, x, offset, offset_origin) - origin) : Vec3(x - origin));
    }
    const Span faces = model.blocks.faces[side.block];
    for (Row f = faces.first; f < faces.end(); ++f) {
        if (model.faces.triangles[f].count == 0) continue;
        work.clip.begin_face();
        for_corners(model, f, [&](Row g) { work.clip.add_corner(static_cast<int>(g - points.first)); });
    }
}

void clip_by(const Model& model, const Side& side, const Vec3& origin, const Vec3& normal, OverlapScratch& work) {
    const Span faces = model.blocks.faces[side.block];
    std::size_t best = 0;
    double most = -2;
    for (Row f = faces.first; f < faces.end(); ++f) {
        if (model.faces.triangles[f].count == 0) continue;
        const Vec3 outward = current_normal(model, f);
        const Row corner = model.triangles.gridpoints[model.faces.triangles[f].first][0];
        const double cosine = side.sense * outward.dot(normal);
        if (cosine > most) {
            most = cosine;
            best = work.of_other.size();
        }
        work.of_other.push_back({outward, outward.dot(model.gridpoints.position[corner] - origin)});
    }
    if (work.of_other.empty()) return;
    // The face that points most directly at the other block first: it leaves little for the others.
    work.clip.clip(work.of_other[best], FaceOrigin::clipper);
    for (std::size_t i = 0; i < work.of_other.size() && !work.clip.empty(); ++i)
        if (i != best) work.clip.clip(work.of_other[i], FaceOrigin::clipper);
}

Vec3 longest_edge_across(const ConvexClip& clip, const Vec3& normal) {
    Vec3 longest = Vec3::Zero();
    for (std::size_t f = 0; f < clip.face_count(); ++f)
        for (int i = 0, n = clip.corner_count(f); i < n; ++i) {
            Vec3 edge = clip.corner(f, (i + 1) % n) - clip.corner(f, i);
            edge -= edge.dot(normal) * normal;
            if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
        }
    return longest;
}

/// Puts one face of a block, out of the list of its faces, into `one`.
void take_face(const Model& model, Row face, const std::vector<HalfSpace>& faces, std::vector<HalfSpace>& one) {
    std::size_t place = 0;
    for (Row f = model.blocks.faces[model.faces.block[face]].first; f < face; ++f)
        place += model.faces.triangles[f].count > 0;
    one.assign(1, faces[place]);
}

/// Blending weight of a pair of faces: 1 when they are nearly parallel, 0 from some angle on, and for corners or edges.
struct Flatness {
    double value = 0;
    Vec3 turned = Vec3::Zero(); ///< minus its derivative to a turn of block 2

    Flatness(const Model& model, const OverlapPair& pair) {
        constexpr double low = nearly_parallel, high = 7.6e-3; // the latter of 7 degrees
        if (pair.face1 == no_row || pair.face2 == no_row) return;
        const Vec3 n1 = current_normal(model, pair.face1), n2 = current_normal(model, pair.face2);
        const double t = (1 + n1.dot(n2) - low) / (high - low);
        if (t >= 1) return;
        value = 1;
        if (t <= 0) return;
        value -= t * t * (3 - 2 * t);
        turned = 6 * t * (1 - t) / (high - low) * n2.cross(n1);
    }
};

} // namespace

double rounding_of_gap(const Model& model, Row block1, Row block2) {
    constexpr double precision = 0x1p-47; // of the farthest coordinate: a sum of some thirty steps loses as much
    constexpr double least = 1e-12;       // of the margin
    const auto& blocks = model.blocks;
    const Vec3 &one = blocks.centroid[block1], &two = blocks.centroid[block2];
    const double far = one.cwiseAbs().cwiseMax(two.cwiseAbs()).maxCoeff();
    return std::max(precision * far, least * std::min(blocks.margin[block1], blocks.margin[block2]));
}
namespace {

/// The common volume of two blocks, relative to its own origin.
struct CommonPart {
    double volume = 0;
    OverlapGradient depth;
    OverlapMoments moments;
    double flatness = 0; ///< see Flatness
};

/// Tips need a least stiffness: the energy of a joint of the least area closed by six times the mean depth q. Edges and wedges carry by
/// themselves: the area falls where the volume V is large beside q^3. docs/theory/contacts.md, equation (10).
struct LeastJoint {
    double blunt;  ///< t/(1 + t), with t the square of V/q^3 over that of a blunt tip
    double energy; ///< over stiffness

    LeastJoint(const CommonPart& common, double least_area) {
        constexpr double of_tip =
            2700; // V/q^3 of a square pyramid whose sides rise by 10 degrees; of a cube's corner 55
        const double mean = common.depth.value / common.volume, ratio = common.volume / (of_tip * mean * mean * mean),
                     whole = 1 + ratio * ratio;
        blunt = 1 - 1 / whole;
        energy = 18 * least_area * (mean * mean) / (whole * whole);
    }
};

/// Energy over stiffness of an overlap: U of the depth, or that of the least joint, whichever is larger, by a smooth norm that is exact far
/// from where they are equal. Returns minus its gradient. `volume_gradient_of` is called only where the least joint counts.
template <class Gradient>
OverlapGradient energy_of(const CommonPart& common, double least_area, Gradient volume_gradient_of) {
    const OverlapGradient& depth = common.depth;
    const LeastJoint joint(common, least_area);
    constexpr double no_part = 0.01; // its eighth power is below rounding
    if (!(joint.energy > no_part * depth.value)) return depth;
    // The power is 8: it is three squarings, and its root three square roots.
    const auto eighth_power = [](double x) { return (x *= x, x *= x, x * x); };
    const auto eighth_root = [](double x) { return std::sqrt(std::sqrt(std::sqrt(x))); };
    const auto seventh_power = [](double x) { return x * x * x * (x * x) * (x * x); };
    const double larger = std::max(joint.energy, depth.value), one = depth.value / larger,
                 other = joint.energy / larger;
    const double sum = eighth_root(eighth_power(one) + eighth_power(other)); // over the larger
    const double of_depth = seventh_power(one / sum), of_joint = seventh_power(other / sum) * joint.energy;
    OverlapGradient energy;
    energy.add(depth, of_depth + of_joint * (2 + 12 * joint.blunt) / depth.value);
    energy.add(volume_gradient_of(), -of_joint * (2 + 16 * joint.blunt) / common.volume);
    energy.value = larger * sum;
    return energy;
}

/// The mean closure 2U/V.
OverlapGradient closure_gradient(const CommonPart& common, const OverlapGradient& volume) {
    const double closure = 2 * common.depth.value / common.volume;
    OverlapGradient slope;
    slope.add(common.depth, 2 / common.volume);
    slope.add(volume, -closure / common.volume);
    slope.value = closure;
    return slope;
}

/// Which of the two blocks is shifted by the offset, and clipped.
bool second_is_subject(const Blocks& blocks, const OverlapPair& pair) {
    return blocks.volume[pair.block2] < blocks.volume[pair.block1];
}

void take_corners(const Model& model, const Side& side, Row face, const Vec3& origin, const ClosureOffset* offset,
                  const Vec3& offset_origin, ConvexFace& taken) {
    taken.corners.clear();
    for_corners(model, face, [&](Row g) {
        const Vec3& x = model.gridpoints.position[g];
        taken.corners.push_back(offset ? Vec3(x + shift(side, x, *offset, offset_origin) - origin) : Vec3(x - origin));
    });
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < taken.corners.size(); ++i)
        sum += (taken.corners[i] - taken.corners[0]).cross(taken.corners[i + 1] - taken.corners[0]);
    const double length = sum.norm();
    taken.outward = length > 0 ? Vec3(sum / length) : Vec3(Vec3::Zero());
}

/// Result for two parallel faces, without the rest of the blocks.
enum class Flat { apart, found, not_known };

/// Nearly all joints that are open in part are flat enough for the wedge between their faces to define the overlap.
Flat find_flat(const Model& model, const OverlapPair& pair, const Vec3& origin, const ClosureOffset& offset,
               OverlapScratch& work) {
    constexpr double flat_enough = 5e-7; // 1 - cosine of an angle of 1e-3
    constexpr double thin_enough =
        1e-2; // greatest closure over the root of the least area: a thousandth of a face's size
    constexpr double small_tilt = 0.03; // 2 degrees, from where Flatness is below 1, less the angle that is flat enough
    if (pair.face1 == no_row || pair.face2 == no_row) return Flat::not_known;
    const bool shifted = offset.closure != 0 || !offset.tilt.isZero(0), second = second_is_subject(model.blocks, pair);
    const Vec3& offset_origin = model.blocks.centroid[pair.block1];
    take_corners(model, {pair.block1, 1}, pair.face1, origin, shifted && !second ? &offset : nullptr, offset_origin,
                 work.face1);
    take_corners(model, {pair.block2, -1}, pair.face2, origin, shifted && second ? &offset : nullptr, offset_origin,
                 work.face2);
    if (!(1 + work.face1.outward.dot(work.face2.outward) < flat_enough)) return Flat::not_known;
    // An offset turns one of the faces; a small one cannot make faces parallel that are not nearly so.
    if (shifted && offset.tilt.squaredNorm() > small_tilt * small_tilt && Flatness(model, pair).value < 1)
        return Flat::not_known;
    const bool found = work.flat.find(work.face1, work.face2);
    if (work.flat.deepest_below() > thin_enough * std::sqrt(pair.least_area)) return Flat::not_known; // sides count too
    return found ? Flat::found : Flat::apart;
}

/// Clips one block with the faces of the other. `faces_of_subject`: also takes those of the block that is clipped. False where nothing remains.
bool clip_pair(const Model& model, const OverlapPair& pair, const Vec3& normal, const Vec3& origin,
               const ClosureOffset& offset, bool faces_of_subject, OverlapScratch& work) {
    work.clip.clear();
    work.of_subject.clear();
    work.of_other.clear();
    const bool second = second_is_subject(model.blocks, pair);
    const Side one{pair.block1, 1}, two{pair.block2, -1};
    add_subject(model, second ? two : one, origin, offset, model.blocks.centroid[pair.block1], work);
    if (faces_of_subject)
        for (std::size_t f = 0; f < work.clip.face_count(); ++f) work.of_subject.push_back(half_space_of(work.clip, f));
    clip_by(model, second ? one : two, origin, normal, work);
    return !work.clip.empty();
}

/// Sheets and threads as thin as the rounding of coordinates have no direction that means anything.
bool is_rounding(const Model& model, const OverlapPair& pair, double volume, double surface) {
    return !(2 * volume > rounding_of_gap(model, pair.block1, pair.block2) * surface);
}

double surface_of(const ConvexClip& clip) {
    double area = 0;
    for (std::size_t f = 0; f < clip.face_count(); ++f) area += clip.area_vector(f).norm();
    return area;
}

/// The common part of two blocks. False where nothing remains, or nothing carries.
bool find_by_clip(const Model& model, const OverlapPair& pair, const Vec3& normal, const Vec3& origin,
                  const ClosureOffset& offset, OverlapScratch& work, CommonPart& common) {
    const bool second = second_is_subject(model.blocks, pair);
    const double first = part_of_first(model, pair.block1, pair.block2), of_subject = second ? 1 - first : first;
    if (!clip_pair(model, pair, normal, origin, offset, of_subject > 0, work)) return false;
    common.moments = moments_of(work.clip);
    if (is_rounding(model, pair, common.moments.volume, surface_of(work.clip))) return false;
    const Flatness flatness(model, pair);
    common.flatness = flatness.value;
    common.volume = common.moments.volume;
    const auto depth_below = [&](const std::vector<HalfSpace>& faces_of_subject,
                                 const std::vector<HalfSpace>& faces_of_other) {
        OverlapGradient depth;
        if (of_subject > 0)
            depth.add(depth_gradient(work.clip, faces_of_subject, true, second, work.depth), of_subject);
        if (of_subject < 1)
            depth.add(depth_gradient(work.clip, faces_of_other, false, second, work.depth), 1 - of_subject);
        return depth;
    };
    if (flatness.value < 1) common.depth.add(depth_below(work.of_subject, work.of_other), 1 - flatness.value);
    if (flatness.value > 0) {
        const double of_all = flatness.value < 1 ? common.depth.value / (1 - flatness.value) : 0;
        if (of_subject > 0) take_face(model, second ? pair.face2 : pair.face1, work.of_subject, work.face_of_subject);
        take_face(model, second ? pair.face1 : pair.face2, work.of_other, work.face_of_other);
        const OverlapGradient of_faces = depth_below(work.face_of_subject, work.face_of_other);
        common.depth.add(of_faces, flatness.value);
        common.depth.moment += (of_faces.value - of_all) * flatness.turned;
    }
    return common.depth.value > 0;
}

double area_along(const ConvexClip& clip, const Vec3& n) {
    double area = 0;
    for (std::size_t f = 0; f < clip.face_count(); ++f) area += 0.5 * std::abs(clip.area_vector(f).dot(n));
    return area;
}

/// Places are relative to it.
Vec3 origin_of(const Model& model, const OverlapPair& pair) {
    return model.blocks.centroid[second_is_subject(model.blocks, pair) ? pair.block2 : pair.block1];
}

/// The part of a vector in a plane; none of one that has no direction there.
std::optional<Vec3> in_plane(const Vec3& vector, const Vec3& normal) {
    const Vec3 flat = vector - vector.dot(normal) * normal;
    return flat.squaredNorm() > 1e-24 + 1e-6 * vector.squaredNorm() ? std::optional(flat) : std::nullopt;
}

ClosureOffset along_normal_or(const ClosureOffset& offset, const Vec3& normal) {
    ClosureOffset moved = offset;
    if (moved.along.isZero(0)) moved.along = normal;
    return moved;
}

} // namespace

double overlap_area(const Model& model, const OverlapPair& pair, const Vec3& normal, const ClosureOffset& offset,
                    OverlapScratch& work) {
    const Vec3 origin = origin_of(model, pair);
    const ClosureOffset moved = along_normal_or(offset, normal);
    const Flat flat = find_flat(model, pair, origin, moved, work);
    if (flat == Flat::found) return work.flat.area();
    if (flat == Flat::apart || !clip_pair(model, pair, normal, origin, moved, false, work)) return 0;
    return area_along(work.clip, normal);
}

OverlapPatch overlap_patch(const Model& model, const OverlapPair& pair, const Vec3& normal, const ClosureOffset& offset,
                           OverlapScratch& work, OverlapSlopes* slopes) {
    const Vec3 origin = origin_of(model, pair);
    const ClosureOffset moved = along_normal_or(offset, normal);
    OverlapPatch patch;
    patch.normal = normal;
    CommonPart common;
    const Flat flat = find_flat(model, pair, origin, moved, work);
    if (flat == Flat::apart) return patch;
    if (flat == Flat::found) {
        common = {work.flat.volume().value, work.flat.depth(), work.flat.moments(), 1};
        if (is_rounding(model, pair, common.volume, 2 * work.flat.area())) return patch;
    } else if (!find_by_clip(model, pair, normal, origin, moved, work, common)) return patch;
    patch.lies = common.flatness > 0.5;
    const auto volume_gradient_of = [&] {
        return flat == Flat::found ? work.flat.volume()
                                   : volume_gradient(work.clip, common.volume, second_is_subject(model.blocks, pair));
    };
    const OverlapGradient energy = energy_of(common, pair.least_area, volume_gradient_of);
    const double force = energy.force.norm();
    if (!(force > 0)) return patch;

    patch.carried = force;
    patch.energy = energy.value;
    patch.normal = energy.force / force;
    const Vec3& n = patch.normal;
    double extent = work.flat.extent();
    // Between flat faces the force may lean by the closure over their size, and the wedge is as thin.
    patch.depth = work.flat.deepest();
    if (flat != Flat::found) {
        double low = std::numeric_limits<double>::infinity(), high = -low, square = 0;
        work.clip.each_vertex([&](const Vec3& v) {
            low = std::min(low, n.dot(v));
            high = std::max(high, n.dot(v));
            square = std::max(square, (v - common.moments.centroid).squaredNorm());
        });
        patch.depth = high - low;
        extent = std::sqrt(square);
    }
    if (!(patch.depth > 0)) return OverlapPatch{.normal = normal};
    // Corners carry up to four joints of the least area, thin slivers some ten: far more is a rounding artefact.
    constexpr double most_carried = 100;
    const double area = flat == Flat::found ? work.flat.area() : area_along(work.clip, n);
    if (force > most_carried * (area + pair.least_area) * patch.depth) return OverlapPatch{.normal = normal};
    // The line of action of the force, at the height of the common volume. It passes through or close to that volume; where the least joint
    // of a sliver carries, it may pass some lengths of the sliver away, since that joint weakens as the sliver grows. Farther lines are
    // rounding artefacts too.
    constexpr double lengths = 10;
    const Vec3 arm = n.cross(energy.moment) / force, aside = arm - common.moments.centroid;
    const double twist = energy.moment.dot(n) / force, farthest = lengths * (extent + std::sqrt(pair.least_area));
    if (std::abs(twist) > farthest || (aside - aside.dot(n) * n).norm() > farthest)
        return OverlapPatch{.normal = normal};
    patch.area = area;
    patch.centre = origin + arm - aside.dot(n) * n;
    patch.twist = twist;
    patch.second = common.moments.second;
    if (slopes != nullptr || !in_plane(pair.axis, n)) // pressure that is not straight turns the normal yet
        patch.longest_edge = flat == Flat::found ? work.flat.longest_edge() : longest_edge_across(work.clip, n);
    if (slopes != nullptr)
        *slopes = {energy, closure_gradient(common, volume_gradient_of()), origin, common.moments.centroid};
    return patch;
}

CarrierRows OverlapPatch::rows(double least) const {
    const double carries = carrying_area(least), each = std::max(area, carries) / carriers,
                 closure = carried / (carriers * each);
    return {each, {closure, closure, closure, closure}};
}

OverlapPair pair_of(const Contacts& contacts, Row c) {
    return {contacts.block1[c], contacts.block2[c],     contacts.face1[c],
            contacts.face2[c],  contacts.least_area[c], contacts.axis[c]};
}

ClosureOffset offset_of(const Contacts& contacts, Row c) {
    return {contacts.offset[c], contacts.offset_tilt[c], contacts.offset_normal[c]};
}

double rung_above(double area, double least) {
    constexpr double per_octave = 4, same = 1e-9; // an area that is a rung but for rounding is that rung
    if (!(area > (1 + same) * least)) return least;
    return least * std::exp2(std::ceil(per_octave * std::log2(area / least) - same) / per_octave);
}

Vec3 axis_in_plane(const Vec3& axis, const Vec3& wanted, const Vec3& normal) {
    for (const Vec3& candidate : {axis, wanted})
        if (const auto flat = in_plane(candidate, normal)) return flat->normalized();
    int least = 0;
    normal.cwiseAbs().minCoeff(&least);
    return normal.cross(Vec3::Unit(least)).normalized();
}

PressureSpread::PressureSpread(const OverlapPatch& patch, const Vec3& along)
    : PressureSpread(patch.centre, patch.second, patch.normal, along) {}

PressureSpread::PressureSpread(const Vec3& of_force, const Mat3& second, const Vec3& normal, const Vec3& along)
    : centre(of_force), u(along), v(normal.cross(along)) {
    const Vec3 of_u = second * u;
    uu = std::max(0.0, u.dot(of_u)), vv = std::max(0.0, v.dot(second * v)), uv = v.dot(of_u);
    square = std::max(0.0, uu * vv - uv * uv);
}

Eight3 PressureSpread::places() const {
    // The root of the 2 x 2 matrix: (M + s I)/t with s^2 = det M, t^2 = trace M + 2 s.
    const double s = std::sqrt(square), t = std::sqrt(uu + vv + 2 * s), over = t > 0 ? 1 / t : 0;
    const Vec3 along = over * ((uu + s) * u + uv * v), across = over * (uv * u + (vv + s) * v);
    static_assert(carriers == 4);
    constexpr Eight of_along{1, -1, -1, 1}, of_across{1, 1, -1, -1}; // the other rows are in the centre
    return eights(centre) + eights(along) * of_along + eights(across) * of_across;
}

Eight PressureSpread::squares_of(const Eight3& arms) const {
    const Eight along = arms.dot(eights(u)), across = arms.dot(eights(v));
    return (along * along * vv - along * across * (2 * uv) + across * across * uu) * (1 / square);
}

} // namespace kaya
