#include "model/cables.hpp"

#include "base/diagnostic.hpp"
#include "model/model.hpp"
#include "model/nearest.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace kaya {

namespace {

/// How far outside of a block, over its size, a node still counts as on its surface.
constexpr double on_surface = 1e-6;

Mat3 turn_of(const Blocks& blocks, Row block) {
    const auto& q = blocks.orientation[block];
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

/// The block that holds a place; no_row when none does.
Row block_at(const Model& model, const Vec3& place) {
    const Row block = nearest_row(model, ObjectKind::block, place);
    if (block == no_row || distance_to(model, ObjectKind::block, block, place) > on_surface * block_size(model, block))
        return no_row;
    return block;
}

/// Shares of a zone's corners in a place; they sum to 1 and may be negative outside of it.
std::array<double, 4> weights_in(const Model& model, Row zone, const Vec3& place) {
    const auto& rows = model.zones.gridpoints[zone];
    const auto& position = model.gridpoints.position;
    const Vec3 origin = position[rows[3]];
    Mat3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = position[rows[static_cast<std::size_t>(k)]] - origin;
    const Vec3 weights = edges.inverse() * (place - origin);
    return {weights[0], weights[1], weights[2], 1 - weights.sum()};
}

void place_in_zone(Model& model, Row node, Row block) {
    auto& nodes = model.structures.nodes;
    const Span zones = model.blocks.zones[block];
    double best = -std::numeric_limits<double>::infinity();
    for (Row zone = zones.first; zone < zones.end(); ++zone) {
        const auto weights = weights_in(model, zone, nodes.position[node]);
        const double least = std::ranges::min(weights);
        if (!(least > best)) continue;
        best = least;
        nodes.zone[node] = zone - zones.first;
        nodes.weights[node] = weights;
    }
}

void place(Model& model, Row node) {
    auto& nodes = model.structures.nodes;
    const auto& blocks = model.blocks;
    const Row block = block_at(model, nodes.position[node]);
    nodes.zone[node] = no_row;
    nodes.weights[node] = {};
    nodes.local[node] = Vec3::Zero();
    nodes.block[node] = block == no_row ? BlockId{} : blocks.id[block];
    nodes.shape[node] = block == no_row ? 0 : blocks.shape[block];
    if (block == no_row) return;
    if (blocks.deformable[block]) place_in_zone(model, node, block);
    else nodes.local[node] = turn_of(blocks, block).transpose() * (nodes.position[node] - blocks.centroid[block]);
}

} // namespace

const std::vector<CableProperty>& cable_properties() {
    using P = CableProperties;
    static const std::vector<CableProperty> rows{
        {"area", &P::area},
        {"young", &P::young},
        {"density", &P::density},
        {"kbond", &P::grout_stiffness},
        {"sbond", &P::grout_cohesion},
        {"fbond", &P::grout_friction},
        {"perimeter", &P::grout_perimeter},
        {"yield", &P::yield_tension},
        {"ycomp", &P::yield_compression},
        {"rupture", &P::rupture_strain},
    };
    return rows;
}

Row block_of_node(const Model& model, Row node) { return model.blocks.ids.row(model.structures.nodes.block[node]); }

Row node_of_cable(const Model& model, std::int32_t number, Row offset) {
    const auto& cables = model.structures.cables;
    const auto found = std::ranges::lower_bound(cables.number, number); // cables stand in the order of their numbers
    if (found == cables.number.end() || *found != number) return no_row;
    const Span nodes = cables.nodes[static_cast<std::size_t>(found - cables.number.begin())];
    return offset >= 0 && offset < nodes.count ? nodes.first + offset : no_row;
}

bool has_bar(const CableNodes& nodes, Row node) {
    const auto next = static_cast<std::size_t>(node) + 1;
    return next < nodes.size() && nodes.cable[next] == nodes.cable[node];
}

Vec3 place_of_node(const Model& model, Row node) {
    const auto& nodes = model.structures.nodes;
    const Row block = block_of_node(model, node);
    if (block == no_row || model.blocks.shape[block] != nodes.shape[node]) return nodes.position[node];
    if (nodes.zone[node] == no_row)
        return model.blocks.centroid[block] + turn_of(model.blocks, block) * nodes.local[node];
    const auto& corners = model.zones.gridpoints[model.blocks.zones[block].first + nodes.zone[node]];
    Vec3 place = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) place += nodes.weights[node][k] * model.gridpoints.position[corners[k]];
    return place;
}

double cable_force(const Model& model, Row node) {
    const auto& nodes = model.structures.nodes;
    const bool before = node > 0 && has_bar(nodes, node - 1), after = has_bar(nodes, node);
    const double sum = (before ? nodes.bar_force[node - 1] : 0) + (after ? nodes.bar_force[node] : 0);
    return before && after ? 0.5 * sum : sum;
}

Row make_cable(Model& model, const NewCable& wanted) {
    auto& [cables, nodes, properties, next_number] = model.structures;
    const Row cable = static_cast<Row>(cables.size()), first = static_cast<Row>(nodes.size());
    const double whole = (wanted.last - wanted.first).norm(), bar = whole / wanted.segments;
    cables.resize(cables.size() + 1);
    cables.number[cable] = next_number++;
    cables.property[cable] = wanted.property;
    cables.tension[cable] = wanted.tension;
    cables.nodes[cable] = {first, wanted.segments + 1};
    nodes.resize(nodes.size() + static_cast<std::size_t>(wanted.segments) + 1);
    for (Row k = 0; k <= wanted.segments; ++k) {
        const Row node = first + k;
        const bool end = k == 0 || k == wanted.segments;
        nodes.cable[node] = cable;
        nodes.position[node] = wanted.first + (static_cast<double>(k) / wanted.segments) * (wanted.last - wanted.first);
        nodes.share[node] = end ? 0.5 * bar : bar;
        nodes.anchored[node] = (k == 0 && wanted.anchor_first) || (k == wanted.segments && wanted.anchor_last);
        if (k < wanted.segments) nodes.bar_length[node] = bar;
        place(model, node);
    }
    ModelEdit(model, Change::contacts);
    return cable;
}

void delete_cables(Model& model, const std::vector<Row>& gone) {
    auto& [cables, nodes, properties, next_number] = model.structures;
    std::vector<Row> kept_cables, kept_nodes;
    for (Row cable = 0; cable < static_cast<Row>(cables.size()); ++cable) {
        if (std::ranges::binary_search(gone, cable)) continue;
        for (Row node = cables.nodes[cable].first; node < cables.nodes[cable].end(); ++node) kept_nodes.push_back(node);
        kept_cables.push_back(cable);
    }
    cables.gather(kept_cables);
    nodes.gather(kept_nodes);
    Row next = 0;
    for (std::size_t cable = 0; cable < cables.size(); ++cable) {
        cables.nodes[cable].first = next;
        for (; next < cables.nodes[cable].end(); ++next) nodes.cable[next] = static_cast<Row>(cable);
    }
    ModelEdit(model, Change::contacts);
}

void take_cable_properties(Model& model) {
    auto& [cables, nodes, properties, next_number] = model.structures;
    for (std::size_t cable = 0; cable < cables.size(); ++cable) {
        const auto found = properties.find(cables.property[cable]);
        if (found == properties.end() || !(found->second.axial_stiffness() > 0))
            throw Diagnostic(
                fmt::format("cable {} has the properties {}, which have no {}", cables.number[cable],
                            cables.property[cable],
                            found == properties.end() || !(found->second.area > 0) ? "area" : "Young's modulus"),
                fmt::format(
                    "write for example: structure property {} area 5e-4 young 2e11 yield 2.5e5 kbond 1e7 sbond 2e5",
                    cables.property[cable]));
        const double tension = std::exchange(cables.tension[cable], 0.0);
        const Span span = cables.nodes[cable];
        for (Row node = span.first; tension != 0 && node + 1 < span.end(); ++node) {
            nodes.bar_length[node] /= 1 + tension / found->second.axial_stiffness();
            nodes.bar_force[node] = tension;
        }
    }
}

void place_cable_nodes(Model& model) {
    const auto& nodes = model.structures.nodes;
    for (Row node = 0; node < static_cast<Row>(nodes.size()); ++node) {
        const Row block = block_of_node(model, node);
        if (block == no_row || model.blocks.shape[block] != nodes.shape[node]) place(model, node);
    }
}

} // namespace kaya
