#include "report/inside_data.hpp"

#include "report/block_corners.hpp"
#include "report/field_data.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace kaya {

namespace {

/// A zone takes some ten bytes of a page.
constexpr std::size_t most_zones = 300'000;

} // namespace

std::string inside_json(const Model& model, const Vec3& centre) {
    if (model.zones.size() > most_zones) return "null";
    std::vector<std::uint32_t> corners, zones, zone_corners;
    std::vector<Row> gridpoints;
    for (Row block = 0; block < static_cast<Row>(model.blocks.size()); ++block) {
        if (model.blocks.hidden[block]) continue;
        BlockCorners of_block(model, block);
        const auto on_surface = static_cast<std::ptrdiff_t>(of_block.rows.size());
        const Span span = model.blocks.zones[block];
        for (Row zone = span.first; zone < span.end(); ++zone)
            for (const Row g : model.zones.gridpoints[zone]) zone_corners.push_back(of_block.add(g));
        gridpoints.insert(gridpoints.end(), of_block.rows.begin() + on_surface, of_block.rows.end());
        corners.push_back(static_cast<std::uint32_t>(of_block.rows.size()) - static_cast<std::uint32_t>(on_surface));
        zones.push_back(static_cast<std::uint32_t>(span.count));
    }
    CornerPlaces places;
    places.add(model, gridpoints, centre);
    return fmt::format(R"({{{},{},{},{},"fields":[{}]}})", column_json("corners", corners), column_json("zones", zones),
                       column_json("zoneCorners", zone_corners), places.json(),
                       fmt::join(corner_fields_json(model, gridpoints), ","));
}

} // namespace kaya
