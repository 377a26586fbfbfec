#include "model/structures/cables.hpp"

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
        const bool end = k == 0 || k == wanted.segments;
        nodes.cable[node] = cable;
        nodes.position[node] = wanted.first + (static_cast<double>(k) / wanted.segments) * (wanted.last - wanted.first);
        nodes.share[node] = end ? 0.5 * bar : bar;
        nodes.anchored[node] = (k == 0 && wanted.anchor_first) || (k == wanted.segments && wanted.anchor_last);
        if (k < wanted.segments) nodes.bar_length[node] = bar;
        place_in_rock(model, finder, nodes, node, nodes.position[node]);
    }
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
