#include "mechanics/overlap_contact.hpp"

#include "geometry/convex_overlap.hpp"
#include "mechanics/contact_geometry.hpp"
#include "mechanics/triple.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace kaya {

namespace {

/// Sub-contacts that carry the force of an overlap; others of the contact rest.
constexpr Row carriers = 4;

/// Calls `visit` with the corners of a rigid block's face, in order: its triangles are a fan.
template <class Visit> void for_corners(const Model& model, Row face, const Visit& visit) {
    const Span span = model.faces.triangles[face];
    if (span.count == 0) return;
    const auto& first = model.triangles.gridpoints[span.first];
    visit(first[0]);
    visit(first[1]);
    for (Row t = span.first; t < span.end(); ++t) visit(model.triangles.gridpoints[t][2]);
}

/// The part of a clip that one block brings.
struct Side {
    Row block;
    double sense; ///< +1: its outward normals look along the contact's normal
};

/// Memory of one thread.
struct Workspace {
    ConvexClip clip, piece;
    std::vector<HalfSpace> of_subject, of_other;
};

/// What closes the joint moves block 1 along the normal, or block 2 against it.
Vec3 shift(const Side& side, const Vec3& x, const Vec3& normal, const ClosureOffset& offset, const Vec3& offset_origin) {
    return side.sense * (offset.closure + offset.tilt.dot(x - offset_origin)) * normal;
}

/// The half space of a face of the polyhedron to be clipped.
HalfSpace half_space_of(const ConvexClip& clip, std::size_t face) {
    const Vec3 outward = clip.area_vector(face).normalized();
    return {outward, outward.dot(clip.corner(face, 0))};
}

void add_subject(const Model& model, const Side& side, const Vec3& origin, const Vec3& normal, const ClosureOffset& offset,
                 const Vec3& offset_origin, Workspace& work) {
    const Span points = model.blocks.gridpoints[side.block];
    const bool shifted = offset.closure != 0 || !offset.tilt.isZero(0);
    for (Row g = points.first; g < points.end(); ++g) {
        const Vec3& x = model.gridpoints.position[g];
        work.clip.add_vertex(shifted ? Vec3(x + shift(side, x, normal, offset, offset_origin) - origin) : Vec3(x - origin));
    }
    const Span faces = model.blocks.faces[side.block];
    for (Row f = faces.first; f < faces.end(); ++f) {
        if (model.faces.triangles[f].count == 0) continue;
        work.clip.begin_face();
        for_corners(model, f, [&](Row g) { work.clip.add_corner(static_cast<int>(g - points.first)); });
    }
    for (std::size_t f = 0; f < work.clip.face_count(); ++f) work.of_subject.push_back(half_space_of(work.clip, f));
}

void clip_by(const Model& model, const Side& side, const Vec3& origin, const Vec3& normal, Workspace& work) {
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
    // The face that looks most at the other block first: it leaves little for the others.
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

/// Whether depths are those below one face of each block. Any depth that goes with a block serves; this one is the
/// closure of the joint, and the faces around it, which bound a strip as wide as the joint is closed, do not count.
bool lie_on_each_other(const Model& model, const OverlapPair& pair) {
    constexpr double cosine = 0.99863; // 3 degrees
    return pair.face1 != no_row && pair.face2 != no_row && current_normal(model, pair.face1).dot(current_normal(model, pair.face2)) < -cosine;
}

/// Leaves one face of a block in the list of its faces.
void keep_face(const Model& model, Row face, std::vector<HalfSpace>& faces) {
    std::size_t place = 0;
    for (Row f = model.blocks.faces[model.faces.block[face]].first; f < face; ++f) place += model.faces.triangles[f].count > 0;
    faces = {HalfSpace(faces[place])};
}

OverlapPair pair_of(const Contacts& contacts, Row c) {
    return {contacts.block1[c], contacts.block2[c], contacts.face1[c], contacts.face2[c], contacts.least_area[c]};
}

} // namespace

double part_of_first(const Model& model, Row block1, Row block2) {
    constexpr double larger = 2;
    const auto& volume = model.blocks.volume;
    if (volume[block1] > larger * volume[block2]) return 1;
    return volume[block2] > larger * volume[block1] ? 0 : 0.5;
}

namespace {

/// Energy over stiffness of an overlap: U of the depth, or that of a joint of the least area, whichever is more, by a
/// norm that is smooth and exact far from where they are equal. Gives minus its gradient.
OverlapGradient energy_of(const OverlapGradient& volume, const OverlapGradient& depth, double least_area) {
    constexpr int power = 8;
    const double mean = depth.value / volume.value;
    // Half of the area times the square of its closure. The mean depth of a corner is a quarter or less of how deep it is.
    constexpr double closure_per_mean = 6;
    const double joint = 0.5 * least_area * (closure_per_mean * mean) * (closure_per_mean * mean);
    const double larger = std::max(joint, depth.value), one = depth.value / larger, other = joint / larger;
    const double sum = std::pow(std::pow(one, power) + std::pow(other, power), 1.0 / power); // over the larger
    const double of_depth = std::pow(one / sum, power - 1), of_joint = std::pow(other / sum, power - 1);
    OverlapGradient energy;
    energy.value = larger * sum;
    energy.force = (of_depth + of_joint * 2 * joint / depth.value) * depth.force - of_joint * 2 * joint / volume.value * volume.force;
    energy.moment = (of_depth + of_joint * 2 * joint / depth.value) * depth.moment - of_joint * 2 * joint / volume.value * volume.moment;
    return energy;
}

double mean_face_area(const Model& model, Row block) {
    const Span faces = model.blocks.faces[block];
    double sum = 0;
    for (Row f = faces.first; f < faces.end(); ++f) {
        const Span span = model.faces.triangles[f];
        for (Row t = span.first; t < span.end(); ++t) {
            const auto& g = model.triangles.gridpoints[t];
            const Vec3& a = model.gridpoints.position[g[0]];
            sum += 0.5 * (model.gridpoints.position[g[1]] - a).cross(model.gridpoints.position[g[2]] - a).norm();
        }
    }
    return faces.count > 0 ? sum / faces.count : 0;
}

} // namespace

double least_contact_area(const Model& model, Row block1, Row block2) {
    constexpr double part = 0.01;
    return part * std::min(mean_face_area(model, block1), mean_face_area(model, block2));
}

bool between_rigid(const Model& model, Row c) {
    return !model.blocks.deformable[model.contacts.block1[c]] && !model.blocks.deformable[model.contacts.block2[c]];
}

OverlapPatch overlap_patch(const Model& model, const OverlapPair& pair, const Vec3& normal, const ClosureOffset& offset) {
    const auto& [block1, block2, face1, face2, least_area] = pair;
    static thread_local Workspace work; // kept for its memory
    work.clip.clear();
    work.of_subject.clear();
    work.of_other.clear();
    const auto& blocks = model.blocks;
    const Side one{block1, 1}, two{block2, -1};
    const bool second_is_subject = blocks.volume[block2] < blocks.volume[block1];
    const Side &subject = second_is_subject ? two : one, &other = second_is_subject ? one : two;
    const Vec3 origin = blocks.centroid[subject.block];
    add_subject(model, subject, origin, normal, offset, blocks.centroid[block1], work);
    clip_by(model, other, origin, normal, work);

    OverlapPatch patch;
    patch.normal = normal;
    if (work.clip.empty()) return patch;
    const OverlapMoments moments = moments_of(work.clip);
    if (!(moments.volume > 0)) return patch;
    patch.lies = lie_on_each_other(model, pair);
    if (patch.lies) {
        keep_face(model, face1, second_is_subject ? work.of_other : work.of_subject);
        keep_face(model, face2, second_is_subject ? work.of_subject : work.of_other);
    }
    const OverlapGradient volume = volume_gradient(work.clip, moments.volume, second_is_subject);
    OverlapGradient depth;
    const double first = part_of_first(model, block1, block2), of_subject = second_is_subject ? 1 - first : first;
    if (of_subject > 0) depth.add(depth_gradient(work.clip, work.of_subject, true, second_is_subject, work.piece), of_subject);
    if (of_subject < 1) depth.add(depth_gradient(work.clip, work.of_other, false, second_is_subject, work.piece), 1 - of_subject);
    if (!(depth.value > 0)) return patch;
    const OverlapGradient energy = energy_of(volume, depth, least_area);
    const double force = energy.force.norm();
    if (!(force > 0)) return patch;

    if (getenv("DBG") && force > 1e-3) for (std::size_t f = 0; f < work.clip.face_count(); ++f) { fprintf(stderr, " face %d:", (int)work.clip.origin(f)); for (int i = 0; i < work.clip.corner_count(f); ++i) fprintf(stderr, " (%.17g %.17g %.17g)", work.clip.corner(f,i).x(), work.clip.corner(f,i).y(), work.clip.corner(f,i).z()); fprintf(stderr, "\n"); }
    patch.carried = force;
    patch.energy = energy.value;
    patch.normal = energy.force / force;
    const Vec3& n = patch.normal;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& v : work.clip.vertices()) {
        low = std::min(low, n.dot(v));
        high = std::max(high, n.dot(v));
    }
    patch.depth = high - low;
    if (!(patch.depth > 0)) return OverlapPatch{.normal = normal};
    // The line along which the force acts, at the height of the common part.
    const Vec3 arm = n.cross(energy.moment) / force;
    patch.centre = origin + arm + (moments.centroid - arm).dot(n) * n;
    patch.twist = energy.moment.dot(n) / force;
    patch.second = moments.second;
    for (std::size_t f = 0; f < work.clip.face_count(); ++f) patch.area += 0.5 * std::abs(work.clip.area_vector(f).dot(n));
    patch.longest_edge = longest_edge_across(work.clip, n);
    return patch;
}

namespace {

/// Motion of a rigid block in a step.
struct StepMotion {
    Vec3 way, turn, centre;

    StepMotion(const Model& model, Row b)
        : way(model.blocks.velocity[b] * model.clock.time_step), turn(model.blocks.rotational_velocity[b] * model.clock.time_step),
          centre(model.blocks.centroid[b]) {}
    Vec3 at(const Vec3& place) const { return way + turn.cross(place - centre); }
};

/// Relative motion of block 2 in a step.
struct RelativeMotion {
    StepMotion one, two;

    RelativeMotion(const Model& model, Row c) : one(model, model.contacts.block1[c]), two(model, model.contacts.block2[c]) {}
    /// With the arms of the start of the step, for forces that acted then: they changed the kinetic energy with these.
    RelativeMotion at_start() const {
        RelativeMotion start = *this;
        start.one.centre -= one.way;
        start.two.centre -= two.way;
        return start;
    }
    Vec3 at(const Vec3& place) const { return two.at(place) - one.at(place); }
};

/// Work of the forces as they are on the motion of the step.
void add_work_of(const Model& model, Row c, const RelativeMotion& motion, JointWork& work) {
    const auto& subs = model.sub_contacts;
    const Vec3 n = model.contacts.normal[c];
    const Span span = model.contacts.sub_contacts[c];
    double joint = 0, friction = 0, fluid = 0, normal = 0;
    for (Row s = span.first; s < span.end(); ++s) {
        normal += subs.normal_force[s];
        const Vec3 way = motion.at(subs.position[s]);
        joint += (subs.normal_force[s] * n + subs.shear_force[s]).dot(way);
        friction += subs.frictional_work[s];
        fluid += subs.pore_pressure[s] * subs.area[s] * n.dot(way);
    }
    joint += normal * model.contacts.twist[c] * n.dot(motion.two.turn - motion.one.turn);
    work.joint[0] += joint;
    work.friction[0] += friction;
    work.fluid[0] += fluid;
}

/// The next step of a ladder of areas upwards, so that the stiffness of a rolling contact does not change in each cycle.
double rung_above(double area, double least) {
    constexpr double per_octave = 4;
    if (!(area > least)) return least;
    return least * std::exp2(std::ceil(per_octave * std::log2(area / least)) / per_octave);
}

/// Energy in the shear springs of a row.
double shear_energy(const SubContacts& subs, Row s) {
    const double stiffness = subs.shear_stiffness[s] * subs.area[s];
    return stiffness > 0 ? 0.5 * Vec3(subs.shear_force[s]).squaredNorm() / stiffness : 0;
}

/// A direction in the plane that turns with the contact.
Vec3 axis_in_plane(const Vec3& axis, const Vec3& wanted, const Vec3& normal) {
    for (const Vec3& candidate : {axis, wanted}) {
        const Vec3 flat = candidate - candidate.dot(normal) * normal;
        if (flat.squaredNorm() > 1e-24 + 1e-6 * candidate.squaredNorm()) return flat.normalized();
    }
    int least = 0;
    normal.cwiseAbs().minCoeff(&least);
    return normal.cross(Vec3::Unit(least)).normalized();
}

/// Four places about the centre that share the force equally and have the second moments of its pressure.
std::array<Vec3, carriers> places_of(const OverlapPatch& patch, const Vec3& u) {
    const Vec3 v = patch.normal.cross(u);
    const double uu = std::max(0.0, u.dot(patch.second * u)), vv = std::max(0.0, v.dot(patch.second * v)), uv = u.dot(patch.second * v);
    // The root of the 2 x 2 matrix: (M + s I)/t with s^2 = det M, t^2 = trace M + 2 s.
    const double s = std::sqrt(std::max(0.0, uu * vv - uv * uv)), t = std::sqrt(uu + vv + 2 * s);
    const double a = t > 0 ? (uu + s) / t : 0, b = t > 0 ? uv / t : 0, d = t > 0 ? (vv + s) / t : 0;
    std::array<Vec3, carriers> places;
    constexpr double sign[carriers][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    for (Row k = 0; k < carriers; ++k)
        places[k] = patch.centre + (a * sign[k][0] + b * sign[k][1]) * u + (b * sign[k][0] + d * sign[k][1]) * v;
    return places;
}

/// Turns the shear forces into the plane and with the mean spin of the blocks about its normal.
void turn_shear(Model& model, Row c, const Vec3& n, const Vec3& turn) {
    auto& subs = model.sub_contacts;
    const double twist = turn.dot(n);
    const Span span = model.contacts.sub_contacts[c];
    for (Row s = span.first; s < span.end(); ++s) {
        const Vec3 force = subs.shear_force[s];
        const double size = force.norm();
        Vec3 flat = force - force.dot(n) * n;
        const double left = flat.norm();
        if (left > 0) flat *= size / left; // it turns; it does not shrink
        subs.shear_force.set(s, flat + twist * n.cross(flat));
    }
}

/// Gives a carrier another area. Its normal traction stays. Its shear force stays where faces lie on each other: if it
/// followed the area, a joint that opens and closes at its edge would lose some each time and creep. On corners and edges
/// that roll, what leaves the contact takes its shear force along. Returns the energy of the shear spring that is lost.
double change_area(SubContacts& subs, Row s, double area, bool lies) {
    const double before = shear_energy(subs, s);
    const double ratio = subs.area[s] > 0 ? area / subs.area[s] : 1;
    subs.normal_force[s] *= ratio;
    if (!lies && ratio < 1) subs.shear_force.set(s, ratio * Vec3(subs.shear_force[s]));
    subs.area[s] = area;
    return before - shear_energy(subs, s);
}

double normal_force_of(const Model& model, Row c) {
    const Span span = model.contacts.sub_contacts[c];
    double sum = 0;
    for (Row s = span.first; s < span.end(); ++s) sum += model.sub_contacts.normal_force[s];
    return sum;
}

ClosureOffset offset_of(const Contacts& contacts, Row c) { return {contacts.offset[c], contacts.offset_tilt[c]}; }

/// A force that was set while nothing overlaps: the offset at which the overlap carries it.
double offset_for_force(const Model& model, Row c, double force, double stiffness) {
    const auto& contacts = model.contacts;
    ClosureOffset offset = offset_of(contacts, c);
    const auto missing = [&](double closure) {
        offset.closure = closure;
        const OverlapPatch patch = overlap_patch(model, pair_of(contacts, c), contacts.normal[c], offset);
        return force - stiffness * patch.carried;
    };
    double low = contacts.offset[c], step = force / (stiffness * contacts.least_area[c]), high = low + step;
    for (int i = 0; i < 60 && missing(high) > 0; ++i) high += (step *= 2);
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (missing(middle) > 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// Writes places, areas, increments for the common part as it is now.
double write_rows(Model& model, Row c, const OverlapPatch& patch, const RelativeMotion& motion) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const Span span = contacts.sub_contacts[c];
    const bool closed = patch.carried > 0;
    const Vec3 n = patch.normal;
    std::array<Vec3, carriers> places{};
    double lost = 0, whole = 0; // area of the joint, the open part of which the rows have that carry nothing
    for (Row s = span.first; s < span.end(); ++s) whole += subs.area[s];
    if (closed) {
        contacts.axis[c] = axis_in_plane(contacts.axis[c], patch.longest_edge, n);
        places = places_of(patch, contacts.axis[c]);
        contacts.position[c] = patch.centre;
        contacts.area[c] = patch.carrying_area(contacts.least_area[c]);
    }
    contacts.depth[c] = closed ? patch.depth : 0;
    contacts.twist[c] = patch.twist;
    for (Row k = 0; k < span.count; ++k) {
        const Row s = span.first + k;
        if (k >= carriers) {
            subs.position.set(s, contacts.position[c]);
            subs.area[s] = span.count > carriers && subs.area[s] > 0 ? std::max(0.0, whole - contacts.area[c]) / (span.count - carriers) : 0;
            subs.normal_displacement_increment[s] = 0;
            subs.shear_displacement_increment.set(s, Vec3::Zero());
            continue;
        }
        if (closed) {
            lost += change_area(subs, s, contacts.area[c] / carriers, patch.lies);
            subs.position.set(s, places[k]);
        } else {
            subs.position.set(s, Vec3(subs.position[s]) + 0.5 * (motion.one.at(subs.position[s]) + motion.two.at(subs.position[s])));
        }
        const Vec3 way = motion.at(subs.position[s]);
        // The joint model's closure is the depth; it stays at what it was while the blocks are apart.
        const double displacement = subs.normal_displacement[s];
        subs.normal_displacement_increment[s] = closed ? -contacts.depth[c] - displacement : std::max(0.0, -displacement);
        subs.shear_displacement_increment.set(s, way - way.dot(n) * n);
    }
    return lost;
}

/// The tilt of an offset turns with block 1. Where the blocks themselves tilt that way, so much less of it is left.
void turn_offset(Contacts& contacts, Row c, const RelativeMotion& motion, const Vec3& origin) {
    Vec3& tilt = contacts.offset_tilt[c];
    const double size = tilt.norm();
    if (!(size > 0)) return;
    tilt += motion.one.turn.cross(tilt);
    const Vec3 along = tilt / size, tilted = (motion.two.turn - motion.one.turn).cross(contacts.normal[c]);
    const double used = std::clamp(tilted.dot(along), 0.0, size);
    tilt -= used * along;
    contacts.offset[c] += used * along.dot(contacts.position[c] - origin);
}

/// How far apart two blocks are along a direction, offset included; a bound of their distance.
double gap_along(const Model& model, Row block1, Row block2, const Vec3& n, const ClosureOffset& offset) {
    double high1 = -std::numeric_limits<double>::infinity(), low2 = -high1;
    const auto& x = model.gridpoints.position;
    const Span one = model.blocks.gridpoints[block1], two = model.blocks.gridpoints[block2];
    const Vec3 origin = model.blocks.centroid[block1];
    for (Row g = one.first; g < one.end(); ++g) {
        const Vec3 from = x[g] - origin;
        high1 = std::max(high1, n.dot(from) + offset.tilt.dot(from));
    }
    for (Row g = two.first; g < two.end(); ++g) low2 = std::min(low2, n.dot(x[g] - origin));
    return low2 - high1 - offset.closure;
}

} // namespace

namespace {

/// Work of the normal force, and of the moment that comes with it, on the motion of a step.
double normal_work(const Model& model, Row c, const RelativeMotion& motion) {
    const auto& contacts = model.contacts;
    const auto& subs = model.sub_contacts;
    const Vec3& n = contacts.normal[c];
    const Span span = contacts.sub_contacts[c];
    double work = 0, force = 0;
    for (Row s = span.first; s < span.end(); ++s) {
        work += subs.normal_force[s] * n.dot(motion.at(subs.position[s]));
        force += subs.normal_force[s];
    }
    return work + force * contacts.twist[c] * n.dot(motion.two.turn - motion.one.turn);
}

void scale_normal_force(Model& model, Row c, double scale) {
    const Span span = model.contacts.sub_contacts[c];
    for (Row s = span.first; s < span.end(); ++s) model.sub_contacts.normal_force[s] *= scale;
}

/// Steps are finite: a contact that closes and opens within a few of them would give back a little more or less than it
/// took. It gives back no more: where the energy that it has taken is below that of its overlap, the force is that of the
/// lower one, within limits, so that the overlap stays what the load asks for. `given_up` is the energy taken, `sunk`
/// the length energy over force, `scale` the part of the force that acts.
void keep_passive(Model& model, Row c) {
    constexpr double least_scale = 0.75, recovery = 2e-3, surplus = 1.1;
    auto& contacts = model.contacts;
    const RelativeMotion motion(model, c);
    const double of_overlap = normal_force_of(model, c) * contacts.sunk[c];
    const double work = 0.5 * normal_work(model, c, motion);
    double& taken = contacts.given_up[c];
    double scale = 1;
    taken -= work;
    if (of_overlap > 0 && taken < of_overlap) {
        taken = std::max(taken, least_scale * least_scale * of_overlap);
        scale = std::sqrt(taken / of_overlap);
        scale_normal_force(model, c, scale);
        taken += (1 - scale) * work + recovery * (of_overlap - taken);
    }
    taken = std::min(taken, surplus * of_overlap);
    contacts.slid[c] = 1 - scale;
}

/// The joint model sees the force of the overlap.
void take_back_scale(Model& model, Row c) {
    double& missing = model.contacts.slid[c];
    if (missing > 0) scale_normal_force(model, c, 1 / (1 - missing));
    missing = 0;
}

} // namespace

double move_overlap_contact(Model& model, Row c, JointWork& work) {
    auto& contacts = model.contacts;
    const Row b1 = contacts.block1[c], b2 = contacts.block2[c];
    const RelativeMotion motion(model, c);
    add_work_of(model, c, motion.at_start(), work);
    contacts.given_up[c] -= 0.5 * normal_work(model, c, motion.at_start());
    take_back_scale(model, c);

    Vec3& n = contacts.normal[c];
    const Vec3 turn = 0.5 * (motion.one.turn + motion.two.turn);
    if (contacts.depth[c] == 0) {
        n = (n + turn.cross(n)).normalized();
        contacts.position[c] += 0.5 * (motion.one.at(contacts.position[c]) + motion.two.at(contacts.position[c]));
        const double force = normal_force_of(model, c), stiffness = model.sub_contacts.normal_stiffness[contacts.sub_contacts[c].first];
        if (force > 0 && stiffness > 0) contacts.offset[c] = offset_for_force(model, c, force, stiffness);
    }
    contacts.axis[c] += turn.cross(contacts.axis[c]);
    turn_offset(contacts, c, motion, model.blocks.centroid[b1]);

    // How much closer they may come in two more steps like this one.
    const double closing = std::max(0.0, -2 * motion.at(contacts.position[c]).dot(n));
    OverlapPatch patch;
    patch.normal = n;
    ClosureOffset offset = offset_of(contacts, c);
    const bool near = contacts.depth[c] > 0 || gap_along(model, b1, b2, n, offset) <= closing;
    double area = 0;
    if (near) {
        patch = overlap_patch(model, pair_of(contacts, c), n, offset);
        area = patch.area;
        if (closing > 0.25 * patch.depth) {
            offset.closure += closing;
            area = std::max(area, overlap_patch(model, pair_of(contacts, c), patch.normal, offset).area);
        }
    }
    n = patch.normal;
    turn_shear(model, c, n, turn);
    const double lost = write_rows(model, c, patch, motion);
    contacts.sunk[c] = patch.carried > 0 ? patch.energy / patch.carried : 0;
    contacts.stiffness_area[c] = rung_above(std::max(area, contacts.area[c]), contacts.least_area[c]);
    return lost;
}

double finish_overlap_contact(Model& model, Row c, JointWork& work) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const Span span = contacts.sub_contacts[c];
    double lost = 0;
    if (contacts.depth[c] == 0) {
        for (Row s = span.first; s < span.end(); ++s) {
            lost += shear_energy(subs, s);
            subs.normal_force[s] = 0;
            subs.shear_force.set(s, Vec3::Zero());
        }
        // Apart: a closure that was there besides that of the places is used up.
        if (contacts.offset[c] > 0) contacts.offset[c] = 0;
        contacts.offset_tilt[c].setZero();
        contacts.given_up[c] = contacts.sunk[c] = 0;
    } else {
        keep_passive(model, c);
    }
    add_work_of(model, c, RelativeMotion(model, c), work);
    for (Row s = span.first; s < span.end(); ++s) {
        subs.normal_displacement[s] += subs.normal_displacement_increment[s];
        subs.shear_displacement.set(s, Vec3(subs.shear_displacement[s]) + Vec3(subs.shear_displacement_increment[s]));
    }
    return lost;
}

bool is_partly_open(const Model& model, Row c) {
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    bool open = false, closed = false;
    for (Row s = span.first; s < span.end(); ++s) {
        if (subs.normal_force[s] < 0) return false;
        (subs.normal_force[s] > 0 ? closed : open) = true;
    }
    return open && closed;
}

namespace {

/// What the sub-contacts of a joint say of its closure.
struct Closures {
    double force = 0; ///< sum over rows
    Vec3 shear = Vec3::Zero();
    Row most = no_row; ///< the row with the greatest traction
    Row open = no_row; ///< one that carries nothing
    double area = 0;
    double deepest = 0;
    double mean_offset = 0; ///< closure besides that of the places, weighted with the forces
    double misfit = 0; ///< by which places are closed or open that the mean offset says are not so
};

/// Closure that belongs to the normal force of a row: that of its spring, or what it has moved if that is more, as of a
/// joint that stiffens.
double closure_of(const SubContacts& subs, Row s) {
    const double stiffness = subs.normal_stiffness[s] * subs.area[s];
    return std::max(stiffness > 0 ? subs.normal_force[s] / stiffness : 0, -subs.normal_displacement[s]);
}

double geometric_closure(const Model& model, Row s, const Vec3& n) {
    const auto& subs = model.sub_contacts;
    return -n.dot(attached_position(model, subs.side2[s]) - attached_position(model, subs.side1[s]));
}

Closures closures_of(const Model& model, Row c) {
    const auto& subs = model.sub_contacts;
    const Vec3 n = model.contacts.normal[c];
    const Span span = model.contacts.sub_contacts[c];
    Closures found;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double greatest = 0, low = infinity, high = -infinity, nearest = -infinity, open = 0;
    for (Row s = span.first; s < span.end(); ++s) {
        found.shear += Vec3(subs.shear_force[s]);
        const bool known = subs.side1[s].attached() && subs.side2[s].attached();
        found.area += subs.area[s];
        if (!(subs.normal_force[s] > 0)) {
            found.open = s;
            if (!known) continue;
            open += geometric_closure(model, s, n) + subs.normal_displacement[s];
            nearest = std::max(nearest, geometric_closure(model, s, n));
            continue;
        }
        found.force += subs.normal_force[s];
        const double closure = closure_of(subs, s), traction = subs.normal_force[s] / subs.area[s];
        const double offset = known ? closure - geometric_closure(model, s, n) : 0;
        found.mean_offset += subs.normal_force[s] * offset;
        low = std::min(low, offset);
        high = std::max(high, offset);
        found.deepest = std::max(found.deepest, closure);
        if (traction > greatest) {
            greatest = traction;
            found.most = s;
        }
    }
    if (found.force > 0) {
        found.mean_offset /= found.force;
        found.misfit = std::max(high - low, nearest + found.mean_offset);
    } else {
        // All open: blocks that were made to overlap still do so without force.
        found.most = span.first;
        found.mean_offset = std::min(0.0, -open / span.count);
    }
    return found;
}

/// The linear closure over a joint whose positive part has the force and the moments that the rows have, over the
/// stiffness: the minimum of a convex function, by Newton's method. The resultant is kept inside the overlap.
ClosureOffset closure_of_resultant(const Model& model, Row c, const Closures& closures) {
    const auto& subs = model.sub_contacts;
    const auto& contacts = model.contacts;
    const Span span = contacts.sub_contacts[c];
    const Vec3 n = contacts.normal[c];
    // The offset is linear in space: the centre of force moves to where the overlap has it by a tilt. A few steps of a
    // secant iteration on the two tilts are enough, since what was set by hand is an estimate itself.
    Vec3 wanted = Vec3::Zero();
    for (Row s = span.first; s < span.end(); ++s) wanted += subs.normal_force[s] / closures.force * Vec3(subs.position[s]);
    const double stiffness = subs.normal_stiffness[closures.most];
    const Row b1 = contacts.block1[c];
    const Vec3 origin = model.blocks.centroid[b1];
    ClosureOffset offset;
    offset.closure = closures.mean_offset;
    const double size = std::sqrt(std::max(contacts.area[c], contacts.least_area[c]));
    const auto scale_to_force = [&](ClosureOffset& o) {
        const auto force_at = [&](double closure) {
            ClosureOffset tried = o;
            tried.closure = closure;
            const OverlapPatch patch = overlap_patch(model, pair_of(contacts, c), n, tried);
            return stiffness * patch.carried;
        };
        const double reach = closures.force / (stiffness * contacts.least_area[c]) + o.tilt.norm() * 2 * size;
        double low = o.closure - reach, high = o.closure + reach;
        for (int i = 0; i < 60 && force_at(high) < closures.force; ++i) high += reach;
        for (int i = 0; i < 60 && force_at(low) > closures.force; ++i) low -= reach;
        for (int i = 0; i < 50; ++i) {
            const double middle = 0.5 * (low + high);
            (force_at(middle) < closures.force ? low : high) = middle;
        }
        o.closure = 0.5 * (low + high);
    };
    // Of the continuous joint the centre moves by tilt I / (A closure); where it is partly open by less and less.
    double tilt_per_way = 12 * closures.deepest / (size * size);
    Vec3 way_before = Vec3::Zero();
    for (int i = 0; i < 60; ++i) {
        scale_to_force(offset);
        const OverlapPatch patch = overlap_patch(model, pair_of(contacts, c), n, offset);
        if (!(patch.carried > 0)) break;
        Vec3 way = wanted - patch.centre;
        way -= way.dot(n) * n;
        if (way.norm() < 1e-3 * size) break;
        tilt_per_way *= way.dot(way_before) < 0 ? 0.3 : 1.6;
        way_before = way;
        // The tilt acts about the centre of the contact, or it would close the joint as a whole.
        const Vec3 more = tilt_per_way * way;
        offset.tilt += more;
        offset.closure -= more.dot(patch.centre - origin);
        constexpr double steepest = 0.2;
        if (offset.tilt.norm() > steepest) {
            const Vec3 turned = offset.tilt * (steepest / offset.tilt.norm() - 1);
            offset.tilt += turned;
            offset.closure -= turned.dot(patch.centre - origin);
            scale_to_force(offset);
            break;
        }
    }
    return offset;
}

/// What a joint model keeps of a row.
struct RowState {
    std::array<double, KAYA_JMODEL_MAX_HISTORY> history{};
    JointObject object;
    std::uint32_t state;
    double normal_stiffness, shear_stiffness, displacement;

    RowState(const SubContacts& subs, Row s)
        : state(subs.state[s]), normal_stiffness(subs.normal_stiffness[s]), shear_stiffness(subs.shear_stiffness[s]),
          displacement(subs.normal_displacement[s]) {
        for (std::int32_t h = 0; h < subs.history_columns; ++h) history[h] = subs.history[h][s];
        if (subs.keeps_objects) object = subs.object[s];
    }
    void put(SubContacts& subs, Row s) const {
        for (std::int32_t h = 0; h < subs.history_columns; ++h) subs.history[h][s] = history[h];
        if (subs.keeps_objects) subs.object[s] = object;
        subs.state[s] = state;
        subs.normal_stiffness[s] = normal_stiffness;
        subs.shear_stiffness[s] = shear_stiffness;
        subs.normal_displacement[s] = displacement;
    }
};

} // namespace

void follow_overlap(Model& model, Row c) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const Span span = contacts.sub_contacts[c];
    const Closures closures = closures_of(model, c);
    ClosureOffset offset;
    constexpr double same = 0.05; // of the deepest closure
    offset.closure = closures.mean_offset;
    if (closures.force > 0 && closures.misfit > same * closures.deepest) offset = closure_of_resultant(model, c, closures);

    const OverlapPatch patch = overlap_patch(model, pair_of(contacts, c), contacts.normal[c], offset);
    const bool closed = patch.carried > 0 && closures.force > 0;
    contacts.kind[c] = ContactKind::overlap;
    contacts.offset[c] = offset.closure;
    contacts.offset_tilt[c] = offset.tilt;
    contacts.depth[c] = closed ? patch.depth : 0;
    contacts.twist[c] = patch.twist;
    contacts.area[c] = patch.carrying_area(contacts.least_area[c]);
    contacts.stiffness_area[c] = rung_above(std::max(patch.area, contacts.area[c]), contacts.least_area[c]);
    contacts.slid[c] = 0;
    contacts.given_up[c] = closures.force * (patch.carried > 0 ? patch.energy / patch.carried : 0);
    std::array<Vec3, carriers> places;
    places.fill(contacts.position[c]);
    if (patch.carried > 0) {
        contacts.normal[c] = patch.normal;
        contacts.axis[c] = axis_in_plane(Vec3::Zero(), patch.longest_edge, patch.normal);
        places = places_of(patch, contacts.axis[c]);
        contacts.position[c] = patch.centre;
    }
    const Vec3 n = contacts.normal[c], shear = closures.shear - closures.shear.dot(n) * n;
    // The rows that carry nothing have the area of the open part, and a history that says that they are open.
    const double open_area = std::max(0.0, closures.area - contacts.area[c]) / std::max<Row>(1, span.count - carriers);
    const Row source_open = closures.open == no_row ? closures.most : closures.open;
    const RowState of_carrier(subs, closures.most), of_open(subs, source_open);
    for (Row k = 0; k < span.count; ++k) {
        const Row s = span.first + k;
        const bool carries = k < carriers;
        (carries ? of_carrier : of_open).put(subs, s);
        subs.area[s] = carries ? contacts.area[c] / carriers : closures.open == no_row ? 0 : open_area;
        subs.normal_force[s] = carries && closed ? closures.force / carriers : 0;
        subs.shear_force.set(s, carries && closed ? Vec3(shear / carriers) : Vec3(Vec3::Zero()));
        if (carries) subs.normal_displacement[s] = closed ? -patch.depth : std::max(0.0, of_carrier.displacement);
        subs.position.set(s, carries ? places[k] : contacts.position[c]);
    }
}

} // namespace kaya
