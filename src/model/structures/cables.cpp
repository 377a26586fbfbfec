#include "model/structures/cables.hpp"

#include "model/kinds/nearest.hpp"
#include "model/tables/model.hpp"

#include <algorithm>
#include <utility>

namespace kaya {

double cable_force(const Model& model, Row node) {
    const auto& nodes = model.structures.cable_nodes;
    const bool before = node > 0 && has_bar(nodes, node - 1), after = has_bar(nodes, node);
    const double sum = (before ? nodes.bar_force[node - 1] : 0) + (after ? nodes.bar_force[node] : 0);
    return before && after ? 0.5 * sum : sum;
}

namespace {

/// A place nearer to a block than this part of a bar lies on its surface.
constexpr double rounding = 1e-9;

/// How much of the straight line from a place in a block to one outside of it lies in the block, 0 to 1; blocks count with their surface.
double part_in_block(const Model& model, Row block, const Vec3& from, const Vec3& to, double near) {
    constexpr int halvings = 40;
    double inside = 0, outside = 1;
    for (int k = 0; k < halvings; ++k) {
        const double part = 0.5 * (inside + outside);
        const Vec3 place = from + part * (to - from);
        (distance_to(model, ObjectKind::block, block, place) <= near ? inside : outside) = part;
    }
    return inside;
}

} // namespace

void share_bars(Model& model, Row cable) {
    auto& nodes = model.structures.cable_nodes;
    const Span span = model.structures.cables.nodes[cable];
    for (Row node = span.first; node < span.end(); ++node) nodes.share[node] = 0;
    for (Row node = span.first; node + 1 < span.end(); ++node) {
        const Vec3 from = nodes.position[node], to = nodes.position[node + 1];
        const Row block = rock_block(model, nodes, node), next = rock_block(model, nodes, node + 1);
        const double length = (to - from).norm(), near = rounding * length;
        const auto part = [&](Row own, const Vec3& here, const Vec3& there) {
            if (block == next) return 0.5;
            return own == no_row ? 0 : part_in_block(model, own, here, there, near);
        };
        nodes.share[node] += part(block, from, to) * length;
        nodes.share[node + 1] += part(next, to, from) * length;
    }
}

Row make_cable(Model& model, const NewCable& wanted) {
    auto& cables = model.structures.cables;
    auto& nodes = model.structures.cable_nodes;
    const Row cable = static_cast<Row>(cables.size()), first = static_cast<Row>(nodes.size());
    const double whole = (wanted.last - wanted.first).norm(), bar = whole / wanted.segments;
    cables.resize(cables.size() + 1);
    cables.number[cable] = model.structures.next_number++;
    cables.property[cable] = wanted.property;
    cables.tension[cable] = wanted.tension;
    cables.nodes[cable] = {first, wanted.segments + 1};
    nodes.resize(nodes.size() + static_cast<std::size_t>(wanted.segments) + 1);
    const BlockFinder finder(model);
    for (Row k = 0; k <= wanted.segments; ++k) {
        const Row node = first + k;
        nodes.cable[node] = cable;
        nodes.position[node] = wanted.first + (static_cast<double>(k) / wanted.segments) * (wanted.last - wanted.first);
        nodes.anchored[node] = (k == 0 && wanted.anchor_first) || (k == wanted.segments && wanted.anchor_last);
        if (k < wanted.segments) nodes.bar_length[node] = bar;
        place_in_rock(model, finder, nodes, node, nodes.position[node]);
    }
    share_bars(model, cable);
    ModelEdit(model, Change::contacts);
    return cable;
}

void delete_cables(Model& model, const std::vector<Row>& gone) {
    auto& cables = model.structures.cables;
    auto& nodes = model.structures.cable_nodes;
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

void tighten_cables(Model& model) {
    auto& cables = model.structures.cables;
    auto& nodes = model.structures.cable_nodes;
    for (std::size_t cable = 0; cable < cables.size(); ++cable) {
        const double tension = std::exchange(cables.tension[cable], 0.0);
        if (tension == 0) continue;
        const double stiffness = model.structures.properties.at(cables.property[cable]).axial_stiffness();
        const Span span = cables.nodes[cable];
        for (Row node = span.first; node + 1 < span.end(); ++node) {
            nodes.bar_length[node] /= 1 + tension / stiffness;
            nodes.bar_force[node] = tension;
        }
    }
}

} // namespace kaya
