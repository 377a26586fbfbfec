#include "model/measure/structure_rows.hpp"

#include <algorithm>

namespace kaya {

Row rock_block(const Model& model, const RockPoints& points, Row row) {
    return model.blocks.ids.row(points.block[row]);
}

bool is_placed(const Model& model, const RockPoints& points, Row row) {
    const Row block = rock_block(model, points, row);
    return block != no_row && model.blocks.shape[block] == points.shape[row];
}

std::int32_t nodes_in_rock(const Model& model, const RockPoints& points, const Span& nodes) {
    std::int32_t count = 0;
    for (Row node = nodes.first; node < nodes.end(); ++node) count += rock_block(model, points, node) != no_row;
    return count;
}

Row block_of_node(const Model& model, Row node) { return rock_block(model, model.structures.cable_nodes, node); }

Row node_of_cable(const Model& model, std::int32_t number, Row offset) {
    const auto& cables = model.structures.cables;
    const auto found = std::ranges::lower_bound(cables.number, number); // cables are sorted by number
    if (found == cables.number.end() || *found != number) return no_row;
    const Span nodes = cables.nodes[static_cast<std::size_t>(found - cables.number.begin())];
    return offset >= 0 && offset < nodes.count ? nodes.first + offset : no_row;
}

bool has_bar(const CableNodes& nodes, Row node) {
    const auto next = static_cast<std::size_t>(node) + 1;
    return next < nodes.size() && nodes.cable[next] == nodes.cable[node];
}

Row member_of_number(const Model& model, std::int32_t number) {
    const auto& numbers = model.structures.members.number;
    const auto found = std::ranges::lower_bound(numbers, number); // members are sorted by number
    return found == numbers.end() || *found != number ? no_row : static_cast<Row>(found - numbers.begin());
}

} // namespace kaya
