#include "model/structures/members.hpp"

#include "model/measure/measure.hpp"
#include "model/tables/model.hpp"
#include "model/kinds/nearest.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace kaya {

namespace {

constexpr double nearly_along = 0.9998; ///< cosine of one degree

Eigen::Quaterniond quaternion_of(const Quaternion& q) { return {q[0], q[1], q[2], q[3]}; }

/// New rows for nodes that lie at these places without force.
Span add_nodes(Model& model, Row member, const std::vector<Vec3>& places, Grip grip) {
    auto& nodes = model.structures.member_nodes;
    const Span span{static_cast<Row>(nodes.size()), static_cast<Row>(places.size())};
    nodes.resize(nodes.size() + places.size());
    for (Row k = 0; k < span.count; ++k) {
        const Row node = span.first + k;
        const Vec3& place = places[static_cast<std::size_t>(k)];
        nodes.member[node] = member;
        nodes.grip[node] = grip;
        nodes.reference[node] = nodes.position[node] = nodes.rock[node] = place;
        nodes.rotation[node] = nodes.rock_turn[node] = Quaternion(1, 0, 0, 0);
    }
    return span;
}

Row add_member(Model& model, StructureKind kind, std::int32_t property, const Vec3& axis, double tolerance) {
    auto& members = model.structures.members;
    const Row member = static_cast<Row>(members.size());
    members.resize(members.size() + 1);
    members.number[member] = model.structures.next_number++;
    members.kind[member] = kind;
    members.property[member] = property;
    members.axis[member] = axis;
    members.tolerance[member] = tolerance;
    members.nodes[member] = {static_cast<Row>(model.structures.member_nodes.size()), 0};
    members.beams[member] = {static_cast<Row>(model.structures.beams.size()), 0};
    members.liners[member] = {static_cast<Row>(model.structures.liners.size()), 0};
    return member;
}

void take_turn_of_block(const Model& model, MemberNodes& nodes, Row node) {
    const Row block = rock_block(model, nodes, node);
    if (block == no_row || model.blocks.deformable[block]) return;
    const Eigen::Quaterniond turn =
        quaternion_of(model.blocks.orientation[block]).conjugate() * quaternion_of(nodes.rotation[node]);
    nodes.rock_turn[node] = {turn.w(), turn.x(), turn.y(), turn.z()};
}

void place_node(Model& model, const BlockFinder& finder, Row node) {
    auto& nodes = model.structures.member_nodes;
    place_in_rock(model, finder, nodes, node, nodes.rock[node], model.structures.members.tolerance[nodes.member[node]]);
    nodes.rock_shift[node] = Vec3::Zero();
    take_turn_of_block(model, nodes, node);
}

/// The mean normal of the uncovered faces of its block at the place; 0 on none.
Vec3 face_normal_at(const Model& model, const BlockFinder& finder, Row block, const Vec3& place, double tolerance) {
    const double on_face = std::max(tolerance, 1e-6 * block_size(model, block));
    Vec3 sum = Vec3::Zero();
    const auto& faces = model.blocks.faces[block];
    for (Row face = faces.first; face < faces.end(); ++face) {
        if (distance_to(model, ObjectKind::face, face, place) > on_face) continue;
        const Vec3 normal = face_area_vector(model, face).normalized();
        const Span triangles = model.faces.triangles[face];
        // In front of the face by more than the tolerance, so that neighbours in its plane do not cover it.
        const auto covered = [&](const Vec3& centre) {
            return finder.other_at(place + 0.01 * (centre - place) + 2 * on_face * normal, block, on_face);
        };
        bool exposed = false;
        for (Row t = triangles.first; t < triangles.end() && !exposed; ++t)
            exposed = !covered(triangle_centroid(model, t));
        if (exposed) sum += normal;
    }
    return sum.norm() > 1e-6 ? Vec3(sum.normalized()) : Vec3(Vec3::Zero());
}

/// Points from one end to the other, each straight part divided equally.
std::vector<Vec3> divided(const std::vector<Vec3>& places, std::int32_t segments) {
    std::vector<Vec3> all{places.front()};
    for (std::size_t part = 1; part < places.size(); ++part)
        for (std::int32_t k = 1; k <= segments; ++k)
            all.push_back(k == segments ? places[part]
                                        : Vec3(places[part - 1] + (static_cast<double>(k) / segments) *
                                                                      (places[part] - places[part - 1])));
    return all;
}

Vec3 across(const Vec3& direction, const Vec3& along) { return direction - direction.dot(along) * along; }

Vec3 axis_y_of(const Vec3& wanted, const Vec3& x) {
    Vec3 axis = wanted;
    if (axis.isZero(0)) axis = std::abs(x.y()) > nearly_along ? Vec3::UnitX() : Vec3::UnitY();
    // Where a beam turns into the direction that was wanted, another one must do.
    if (across(axis, x).norm() < 1e-3 * axis.norm())
        axis = std::abs(x.z()) > nearly_along ? Vec3::UnitX() : Vec3::UnitZ();
    return across(axis, x).normalized();
}

/// Normals and areas of the nodes of a mesh: normals by the angles of the triangles around, areas a third of theirs.
void take_surface(MemberNodes& nodes, Row first, const SurfaceMesh& mesh) {
    for (const auto& triangle : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(triangle[(k + i) % 3])]; };
            const Vec3 a = at(1) - at(0), b = at(2) - at(0), normal = a.cross(b);
            const Row node = first + triangle[k];
            nodes.normal[node] += std::atan2(normal.norm(), a.dot(b)) * normal.normalized();
            nodes.share[node] += normal.norm() / 6;
        }
    for (Row node = first; node < first + static_cast<Row>(mesh.points.size()); ++node)
        if (const double length = nodes.normal[node].norm(); length > 0) nodes.normal[node] /= length;
}

} // namespace

Row make_beam(Model& model, const NewBeam& wanted) {
    auto& nodes = model.structures.member_nodes;
    auto& beams = model.structures.beams;
    const Row member = add_member(model, beam_kind, wanted.property, wanted.axis, wanted.tolerance);
    const std::vector<Vec3> places = divided(wanted.places, wanted.segments);
    const Span span = add_nodes(model, member, places, wanted.grip);
    if (wanted.first != Grip::link) nodes.grip[span.first] = wanted.first;
    if (wanted.last != Grip::link) nodes.grip[span.end() - 1] = wanted.last;
    const Row first = static_cast<Row>(beams.size());
    beams.resize(beams.size() + places.size() - 1);
    for (Row k = 0; k + 1 < span.count; ++k) {
        const Row beam = first + k, a = span.first + k;
        const Vec3 chord = nodes.reference[a + 1] - nodes.reference[a];
        beams.member[beam] = member;
        beams.nodes[beam] = {a, a + 1};
        beams.axis_y[beam] = axis_y_of(wanted.axis, chord.normalized());
        for (const Row node : {a, a + 1}) nodes.share[node] += 0.5 * chord.norm();
    }
    model.structures.members.nodes[member] = span;
    model.structures.members.beams[member] = {first, span.count - 1};
    const BlockFinder finder(model);
    for (Row node = span.first; node < span.end(); ++node) {
        place_node(model, finder, node);
        if (const Row block = rock_block(model, nodes, node); block != no_row)
            nodes.normal[node] = face_normal_at(model, finder, block, nodes.reference[node], wanted.tolerance);
    }
    ModelEdit(model, Change::contacts);
    return member;
}

Row make_liner(Model& model, const NewLiner& wanted) {
    auto& nodes = model.structures.member_nodes;
    auto& liners = model.structures.liners;
    const Row member = add_member(model, liner_kind, wanted.property, wanted.axis, wanted.tolerance);
    const Span span = add_nodes(model, member, wanted.mesh.points, wanted.grip);
    take_surface(nodes, span.first, wanted.mesh);
    const Row first = static_cast<Row>(liners.size());
    liners.resize(liners.size() + wanted.mesh.triangles.size());
    for (std::size_t k = 0; k < wanted.mesh.triangles.size(); ++k) {
        const auto& corners = wanted.mesh.triangles[k];
        const std::size_t row = static_cast<std::size_t>(first) + k;
        liners.member[row] = member;
        liners.nodes[row] = {span.first + corners[0], span.first + corners[1], span.first + corners[2]};
        const auto at = [&](std::size_t i) { return nodes.reference[static_cast<std::size_t>(liners.nodes[row][i])]; };
        liners.normal[row] = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
        liners.axis[row] = liner_axis(wanted.axis, liners.normal[row]);
    }
    model.structures.members.nodes[member] = span;
    model.structures.members.liners[member] = {first, static_cast<Row>(wanted.mesh.triangles.size())};
    const BlockFinder finder(model);
    for (Row node = span.first; node < span.end(); ++node) place_node(model, finder, node);
    ModelEdit(model, Change::contacts);
    return member;
}

Vec3 liner_axis(const Vec3& wanted, const Vec3& normal) {
    Vec3 axis = wanted.isZero(0) ? Vec3(Vec3::UnitX()) : Vec3(wanted.normalized());
    if (std::abs(axis.dot(normal)) > nearly_along)
        axis = wanted.isZero(0) ? Vec3(Vec3::UnitY()) : normal.unitOrthogonal();
    return across(axis, normal).normalized();
}

void delete_members(Model& model, const std::vector<Row>& gone) {
    auto& structures = model.structures;
    auto& members = structures.members;
    std::vector<Row> kept, nodes, beams, liners;
    std::vector<Row> renamed(structures.member_nodes.size(), no_row);
    for (Row member = 0; member < static_cast<Row>(members.size()); ++member) {
        if (std::ranges::binary_search(gone, member)) continue;
        const auto keep = [](std::vector<Row>& rows, Span& span) {
            const Row first = static_cast<Row>(rows.size());
            for (Row row = span.first; row < span.end(); ++row) rows.push_back(row);
            span.first = first;
        };
        for (Row k = 0; k < members.nodes[member].count; ++k)
            renamed[static_cast<std::size_t>(members.nodes[member].first + k)] = static_cast<Row>(nodes.size()) + k;
        keep(nodes, members.nodes[member]);
        keep(beams, members.beams[member]);
        keep(liners, members.liners[member]);
        kept.push_back(member);
    }
    members.gather(kept);
    structures.member_nodes.gather(nodes);
    structures.beams.gather(beams);
    structures.liners.gather(liners);
    for (auto& ends : structures.beams.nodes)
        for (Row& node : ends) node = renamed[static_cast<std::size_t>(node)];
    for (auto& corners : structures.liners.nodes)
        for (Row& node : corners) node = renamed[static_cast<std::size_t>(node)];
    for (Row member = 0; member < static_cast<Row>(members.size()); ++member) {
        const auto own = [member](Column<Row>& owners, const Span& span) {
            std::fill_n(owners.begin() + span.first, span.count, member);
        };
        own(structures.member_nodes.member, members.nodes[member]);
        own(structures.beams.member, members.beams[member]);
        own(structures.liners.member, members.liners[member]);
    }
    ModelEdit(model, Change::contacts);
}

void place_member_nodes(Model& model, const BlockFinder& finder) {
    auto& nodes = model.structures.member_nodes;
    for (Row node = 0; node < static_cast<Row>(nodes.size()); ++node) {
        if (is_placed(model, nodes, node)) continue;
        place_node(model, finder, node);
        if (rock_block(model, nodes, node) != no_row) continue;
        nodes.link_slip[node] = nodes.rock_force[node] = nodes.rock_moment[node] = Vec3::Zero();
        nodes.link_state[node] = 0;
    }
}

Hold hold_of(const Model& model, Row node) {
    const auto& nodes = model.structures.member_nodes;
    const Row block = rock_block(model, nodes, node);
    if (block == no_row) return Hold::none;
    if (nodes.grip[node] == Grip::clamp && !model.blocks.deformable[block]) return Hold::clamped;
    if (nodes.grip[node] != Grip::link) return Hold::pinned;
    const auto& properties = model.structures.properties;
    const auto found = properties.find(model.structures.members.property[nodes.member[node]]);
    if (found == properties.end()) return Hold::none;
    if (!found->second.has_springs()) return Hold::pinned;
    return found->second.link_normal == 0 && found->second.link_shear == 0 ? Hold::none : Hold::springs;
}

Vec3 normal_of_node(const Model& model, Row node) {
    const auto& nodes = model.structures.member_nodes;
    return quaternion_of(nodes.rotation[node]) * nodes.normal[node];
}

double link_tension_of(const Model& model, Row node) {
    const auto& nodes = model.structures.member_nodes;
    return nodes.share[node] > 0 ? nodes.rock_force[node].dot(normal_of_node(model, node)) / nodes.share[node] : 0;
}

double link_shear_of(const Model& model, Row node) {
    const auto& nodes = model.structures.member_nodes;
    const Vec3 force = nodes.rock_force[node];
    return nodes.share[node] > 0 ? across(force, normal_of_node(model, node)).norm() / nodes.share[node] : 0;
}

} // namespace kaya
