#include "mechanics/zone_tiles.hpp"

#include <algorithm>

namespace kaya {

namespace {

/// Adds the gridpoints of zones to a tile as long as there is room.
class TilePoints {
public:
    TilePoints(std::size_t gridpoints, std::vector<Row>& points) : place_(gridpoints, no_row), points_(points) {}

    void begin() { first_ = static_cast<Row>(points_.size()); }
    Span points() const { return {first_, static_cast<Row>(points_.size()) - first_}; }

    /// The corners as points of the tile; false where they would be too many.
    bool add(const std::array<Row, 4>& gridpoints, std::array<Row, 4>& corners) {
        const auto is_new = [&](Row g) { return place_[g] < first_; };
        const auto more = std::ranges::count_if(gridpoints, is_new);
        if (points().count + more > most_points_in_tile) return false;
        for (std::size_t a = 0; a < 4; ++a) {
            Row& place = place_[gridpoints[a]];
            if (place < first_) {
                place = static_cast<Row>(points_.size());
                points_.push_back(gridpoints[a]);
            }
            corners[a] = place - first_;
        }
        return true;
    }

private:
    std::vector<Row> place_; ///< of each gridpoint: the last point that it became
    std::vector<Row>& points_;
    Row first_ = 0;
};

} // namespace

ZoneTiles::ZoneTiles(const Model& model, const std::function<std::size_t(Row zone)>& law_of)
    : corners(model.zones.size()) {
    const Row zones = static_cast<Row>(model.zones.size());
    TilePoints points(model.gridpoints.size(), gridpoints);
    for (Row z = 0; z < zones;) {
        const std::size_t law = law_of(z);
        Row last = z;
        points.begin();
        while (last < zones && last - z < most_zones_in_tile && law_of(last) == law &&
               points.add(model.zones.gridpoints[last], corners[last]))
            ++last;
        tiles.push_back({z, last, law, points.points()});
        z = last;
    }
    points_of = sorted_lists<Row>(model.gridpoints.size(), [&](auto add) {
        for (Row p = 0; p < static_cast<Row>(gridpoints.size()); ++p) add(gridpoints[p], p);
    });
}

} // namespace kaya
