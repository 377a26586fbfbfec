#include "mechanics/shape/edges.hpp"

#include <algorithm>
#include <cstdint>

namespace kaya {

void edges_of(const Model& model, Row block, std::vector<Edge>& edges) {
    struct Side {
        std::uint64_t ends; ///< lower gridpoint, then higher: one number, quick to compare
        Row face;
    };
    std::vector<Side> sides;
    sides.reserve(3 * static_cast<std::size_t>(model.blocks.triangles[block].count));
    for (Row f = model.blocks.faces[block].first; f < model.blocks.faces[block].end(); ++f) {
        const Span span = model.faces.triangles[f];
        for (Row t = span.first; t < span.end(); ++t)
            for (int k = 0; k < 3; ++k) {
                const auto& g = model.triangles.gridpoints[t];
                const auto [low, high] = std::minmax(g[k], g[(k + 1) % 3]);
                sides.push_back({static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high), f});
            }
    }
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.ends != b.ends ? a.ends < b.ends : a.face < b.face; });
    edges.clear();
    for (std::size_t i = 0; i + 1 < sides.size(); ++i)
        if (sides[i].ends == sides[i + 1].ends && sides[i].face != sides[i + 1].face)
            edges.push_back({{static_cast<Row>(sides[i].ends >> 32), static_cast<Row>(sides[i].ends & 0xffffffff)},
                             {sides[i].face, sides[i + 1].face}});
}

} // namespace kaya
