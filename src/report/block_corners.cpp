#include "report/block_corners.hpp"

#include "report/packed.hpp"

#include <fmt/format.h>

namespace kaya {

BlockCorners::BlockCorners(const Model& model, Row block) {
    const Span triangles = model.blocks.triangles[block];
    for (Row t = triangles.first; t < triangles.end(); ++t)
        for (const Row g : model.triangles.gridpoints[t]) add(g);
}

std::uint32_t BlockCorners::add(Row gridpoint) {
    const auto [found, is_new] = number.try_emplace(gridpoint, static_cast<std::uint32_t>(rows.size()));
    if (is_new) rows.push_back(gridpoint);
    return found->second;
}

void CornerPlaces::add(const Vec3& place, const Vec3& displacement) {
    for (int k = 0; k < 3; ++k) {
        places.push_back(static_cast<float>(place[k]));
        displacements.push_back(static_cast<float>(displacement[k]));
    }
}

void CornerPlaces::add(const Model& model, std::span<const Row> gridpoints, const Vec3& centre) {
    for (const Row g : gridpoints) add(model.gridpoints.position[g] - centre, model.gridpoints.displacement[g]);
}

std::string CornerPlaces::json() const {
    return fmt::format(R"("places":"{}","displacements":"{}")", packed_rounded(places), packed_rounded(displacements));
}

std::string column_json(const char* name, const std::vector<std::uint32_t>& numbers) {
    return fmt::format("\"{}\":\"{}\"", name, packed(std::span(numbers)));
}

} // namespace kaya
