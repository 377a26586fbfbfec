// add_cables.
#include "model/structures/cables.hpp"
#include "pictures/colouring.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace kaya {

void add_cables(Scene& scene, const Model& model, const Shown& shown, const std::string& word) {
    const Field& field = *find_field(ObjectKind::cable_node, word);
    const auto& nodes = model.structures.cable_nodes;
    Layer layer;
    layer.kind = Layer::Kind::lines;
    layer.width = 5;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto cut_off = [&](Row node) {
        return shown.cut && (nodes.position[node] - shown.cut->origin).dot(shown.cut->normal) > 0;
    };
    for (Row node = 0; node < static_cast<Row>(nodes.size()); ++node) {
        if (!has_bar(nodes, node) || cut_off(node) || cut_off(node + 1)) continue;
        for (const Row end : {node, node + 1}) {
            for (int k = 0; k < 3; ++k) layer.points.push_back(static_cast<float>(nodes.position[end][k]));
            const double value = std::get<double>(field.get(model, end));
            layer.values.push_back(static_cast<float>(value));
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    if (layer.points.empty()) return;
    layer.bar = static_cast<std::int32_t>(scene.bars.size());
    scene.bars.push_back(colour_bar(
        fmt::format("{} [{}]", word == "slip" ? "slip of the grout" : "tension of the cables", field.unit), low, high));
    scene.layers.push_back(std::move(layer));
}

} // namespace kaya
