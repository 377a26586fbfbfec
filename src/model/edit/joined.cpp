#include "model/edit/joined.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/polyhedra/face_contact.hpp"
#include "model/edit/build.hpp"
#include "model/measure/turn.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <set>

namespace kaya {

namespace {

/// Inertia of a block of density mass/volume about its own centroid, global axes.
Mat3 block_inertia(const Model& model, Row b, double mass) {
    const Mat3 r = turn_of(model.blocks, b);
    return mass / model.blocks.volume[b] * (r * model.blocks.inertia[b] * r.transpose());
}

bool masses_known(const Model& model, std::span<const Row> members) {
    return std::all_of(members.begin(), members.end(), [&](Row b) { return model.blocks.mass[b] > 0; });
}

/// Gives all members the motion of one rigid body with the momenta that they have.
void share_motion(Model& model, std::span<const Row> members) {
    auto& blocks = model.blocks;
    const BodyMass body = body_mass(model, members);
    const bool known = masses_known(model, members);
    Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
    for (const Row b : members) {
        const double mass = known ? blocks.mass[b] : blocks.volume[b];
        momentum += mass * blocks.velocity[b];
        angular += block_inertia(model, b, mass) * blocks.rotational_velocity[b] +
                   mass * (blocks.centroid[b] - body.centroid).cross(blocks.velocity[b]);
    }
    Vec3 velocity = momentum / body.mass, spin = body.inertia.ldlt().solve(angular);
    if (keep_held(blocks, members, velocity, spin) != 0) angular = body.inertia * spin;
    for (const Row b : members) {
        blocks.velocity[b] = velocity + spin.cross(blocks.centroid[b] - body.centroid);
        blocks.rotational_velocity[b] = spin;
        blocks.angular_momentum[b] = Vec3::Zero();
        blocks.inertial_mass[b] = blocks.mass[b]; // the momentum below is that of true masses
    }
    if (known) blocks.angular_momentum[members.front()] = angular;
}

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

} // namespace

JoinedBodies joined_bodies(const Model& model) {
    const auto& body = model.blocks.body;
    JoinedBodies bodies;
    for (std::size_t b = 0; b < body.size(); ++b)
        if (body[b] != 0 && !model.blocks.deformable[b]) bodies.rows.push_back(static_cast<Row>(b));
    std::stable_sort(bodies.rows.begin(), bodies.rows.end(), [&](Row a, Row b) { return body[a] < body[b]; });
    for (std::size_t i = 1; i <= bodies.rows.size(); ++i)
        if (i == bodies.rows.size() || body[bodies.rows[i]] != body[bodies.rows[i - 1]]) bodies.start.push_back(i);
    return bodies;
}

std::uint8_t keep_held(const Blocks& blocks, std::span<const Row> members, Vec3& velocity, Vec3& spin) {
    std::uint8_t held = 0;
    for (const Row b : members) {
        for (int k = 0; k < 3; ++k) {
            if (blocks.fixed[b] & ~held & (fix_x << k)) velocity[k] = blocks.velocity[b][k];
            if (blocks.fixed[b] & ~held & (fix_rx << k)) spin[k] = blocks.rotational_velocity[b][k];
        }
        held |= blocks.fixed[b];
    }
    return held;
}

BodyMass body_mass(const Model& model, std::span<const Row> members) {
    const auto& blocks = model.blocks;
    const bool known = masses_known(model, members);
    const auto mass_of = [&](Row b) { return known ? blocks.mass[b] : blocks.volume[b]; };
    BodyMass body;
    for (const Row b : members) {
        body.mass += mass_of(b);
        body.centroid += mass_of(b) * blocks.centroid[b];
    }
    body.centroid /= body.mass;
    for (const Row b : members) {
        const Vec3 arm = blocks.centroid[b] - body.centroid;
        body.inertia += block_inertia(model, b, mass_of(b)) +
                        mass_of(b) * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
    }
    return body;
}

void join_pairs(Model& model, const std::vector<std::pair<Row, Row>>& pairs) {
    auto& blocks = model.blocks;
    for (const auto& [a, b] : pairs) {
        if (blocks.deformable[a] == blocks.deformable[b]) continue;
        const auto [zoned, rigid] = blocks.deformable[a] ? std::pair(a, b) : std::pair(b, a);
        throw Diagnostic(fmt::format("block {} has zones and block {} has none: they cannot be joined",
                                     blocks.number[zoned], blocks.number[rigid]),
                         "give zones to both or to neither");
    }
    std::vector<std::size_t> parent(blocks.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto unite = [&](Row a, Row b) {
        const std::size_t i = root_of(parent, static_cast<std::size_t>(a)),
                          j = root_of(parent, static_cast<std::size_t>(b));
        parent[std::max(i, j)] = std::min(i, j);
    };
    std::map<std::int32_t, Row> first_of_body;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (blocks.body[b] != 0)
            unite(first_of_body.try_emplace(blocks.body[b], static_cast<Row>(b)).first->second, static_cast<Row>(b));
    std::set<std::size_t> changed;
    for (const auto& [a, b] : pairs) unite(a, b);
    for (const auto& [a, b] : pairs) changed.insert(root_of(parent, static_cast<std::size_t>(a)));
    std::map<std::size_t, std::vector<Row>> members;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (const std::size_t root = root_of(parent, b); changed.contains(root))
            members[root].push_back(static_cast<Row>(b));
    for (const auto& [root, rows] : members) {
        for (const Row b : rows) {
            blocks.body[b] = blocks.number[rows.front()];
            blocks.tied_shape[b] = 0;
        }
        if (!blocks.deformable[rows.front()]) share_motion(model, rows);
    }
    if (!pairs.empty()) ModelEdit(model, Change::blocks);
}

std::vector<std::pair<Row, Row>> adjacent_pairs(const Model& model, const std::vector<Row>& rows) {
    std::vector<Polyhedron> shapes;
    std::vector<Box> boxes;
    for (const Row row : rows) {
        shapes.push_back(shape_of(model, row));
        const Box box = box_around(shapes.back().vertices);
        const Vec3 margin = Vec3::Constant(model.blocks.margin[row]);
        boxes.push_back({box.low - margin, box.high + margin});
    }
    std::vector<std::pair<Row, Row>> pairs;
    for (const auto& [i, j] : overlapping_boxes(boxes)) {
        const double near = std::min(model.blocks.margin[rows[i]], model.blocks.margin[rows[j]]);
        if (faces_in_contact(shapes[i], shapes[j], near)) pairs.emplace_back(rows[i], rows[j]);
    }
    return pairs;
}

void unjoin(Model& model, const std::vector<Row>& rows) {
    auto& blocks = model.blocks;
    std::set<std::int32_t> apart;
    for (const Row row : rows)
        if (blocks.body[row] != 0) apart.insert(blocks.body[row]);
    if (apart.empty()) return;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks.body[b] == 0 || !apart.contains(blocks.body[b])) continue;
        const Row row = static_cast<Row>(b);
        blocks.body[b] = blocks.tied_shape[b] = 0;
        if (blocks.deformable[b]) continue;
        blocks.angular_momentum[b] = block_inertia(model, row, blocks.mass[b]) * blocks.rotational_velocity[b];
        blocks.inertial_mass[b] = blocks.mass[b];
    }
    ModelEdit(model, Change::blocks);
}

} // namespace kaya
