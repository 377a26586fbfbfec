#include "mechanics/zones/zone_tiles.hpp"

#include <algorithm>
#include <span>

namespace kaya {

namespace {

/// Adds the gridpoints of zones to a tile as long as there is room.
class TilePoints {
public:
    TilePoints(std::size_t gridpoints, std::vector<Row>& points) : place_(gridpoints, no_row), points_(points) {}

    void begin() { first_ = static_cast<Row>(points_.size()); }
    Span points() const { return {first_, static_cast<Row>(points_.size()) - first_}; }

    /// Whether there is room for the corners of zones; a new one that several have is counted for each.
    bool have_room(std::span<const std::array<Row, 4>> zones) const {
        Row more = 0;
        for (const auto& gridpoints : zones)
            more += static_cast<Row>(std::ranges::count_if(gridpoints, [&](Row g) { return place_[g] < first_; }));
        return points().count + more <= most_points_in_tile;
    }
    /// The corners as points of the tile.
    void add(const std::array<Row, 4>& gridpoints, ZoneCorners& corners) {
        for (std::size_t a = 0; a < 4; ++a) {
            Row& place = place_[gridpoints[a]];
            if (place < first_) {
                place = static_cast<Row>(points_.size());
                points_.push_back(gridpoints[a]);
            }
            corners[a] = static_cast<TilePoint>(place - first_);
        }
    }

private:
    std::vector<Row> place_; ///< of each gridpoint: the last point that it became
    std::vector<Row>& points_;
    Row first_ = 0;
};

} // namespace

ZoneTiles::ZoneTiles(const Model& model, const std::function<std::size_t(Row zone)>& law_of,
                     const std::function<Row(std::size_t law)>& together)
    : corners(model.zones.size()) {
    const Row zones = static_cast<Row>(model.zones.size());
    TilePoints points(model.gridpoints.size(), gridpoints);
    for (Row z = 0; z < zones;) {
        const std::size_t law = law_of(z);
        const Row unit = together(law);
        Row last = z;
        points.begin();
        while (last < zones && last - z + unit <= most_zones_in_tile && law_of(last) == law &&
               points.have_room({&model.zones.gridpoints[last], static_cast<std::size_t>(unit)}))
            for (const Row end = last + unit; last < end; ++last)
                points.add(model.zones.gridpoints[last], corners[last]);
        tiles.push_back({z, last, law, points.points()});
        if (unit == zones_of_cell) add_cells(tiles.back());
        z = last;
    }
    points_of = sorted_lists<Row>(model.gridpoints.size(), [&](auto add) {
        for (Row p = 0; p < static_cast<Row>(gridpoints.size()); ++p) add(gridpoints[p], p);
    });
    ruled.assign(cells.size(), 0);
    outer.assign(cells.size(), 0);
}

void ZoneTiles::add_cells(ZoneTile& tile) {
    tile.has_cells = true;
    tile.first_group = groups();
    for (Row zone = tile.first; zone < tile.last; zone += zones_of_cell)
        cells.push_back(corners_of_cell(&corners[zone]));
    while (cells.size() % cells_of_group != 0) cells.push_back(cells.back());
}

} // namespace kaya
