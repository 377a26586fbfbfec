// add_crosses and add_iso_surfaces.
#include "model/measure/measure.hpp"
#include "pictures/colouring.hpp"
#include "pictures/half_space.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

void push_layer(Scene& scene, Layer layer, ColourBar bar) {
    layer.bar = static_cast<std::int32_t>(scene.bars.size());
    scene.bars.push_back(std::move(bar));
    scene.layers.push_back(std::move(layer));
}

template <class Visit> void each_zone(const Model& model, const Shown& shown, Visit&& visit) {
    for (const Row block : shown.blocks) {
        const Span zones = model.blocks.zones[block];
        for (Row zone = zones.first; zone < zones.end(); ++zone) visit(block, zone);
    }
}

Vec3 drawn_place(const Model& model, const Shown& shown, Row gridpoint) {
    return model.gridpoints.position[gridpoint] + shown.deformation * model.gridpoints.displacement[gridpoint];
}

/// Values at gridpoints: for quantities of zones and blocks the mean of the adjacent ones.
std::vector<float> at_gridpoints(const Model& model, const Shown& shown, Colouring& colouring) {
    std::vector<double> sum(model.gridpoints.size()), weight(model.gridpoints.size());
    each_zone(model, shown, [&](Row block, Row zone) {
        const double volume = zone_volume(model, zone);
        const double value = colouring.table() == ObjectKind::gridpoint
                                 ? 0
                                 : colouring.value(model, colouring.table() == ObjectKind::zone ? zone : block);
        for (const Row g : model.zones.gridpoints[zone]) {
            sum[g] += colouring.table() == ObjectKind::gridpoint
                          ? volume * static_cast<double>(colouring.value(model, g))
                          : volume * value;
            weight[g] += volume;
        }
    });
    std::vector<float> values(sum.size(), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t g = 0; g < sum.size(); ++g)
        if (weight[g] > 0) values[g] = static_cast<float>(sum[g] / weight[g]);
    return values;
}

/// Where a value that is linear in a zone has this level.
Polygon level_in(const std::array<Corner, 4>& corners, double level) {
    Polygon polygon;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) {
            const double a = static_cast<double>(corners[i].value) - level,
                         b = static_cast<double>(corners[j].value) - level;
            if (!std::isfinite(a + b)) return {};
            if ((a < 0) == (b < 0)) continue;
            polygon.push_back(
                {corners[i].place + a / (a - b) * (corners[j].place - corners[i].place), static_cast<float>(level)});
        }
    if (polygon.size() < 3) return {};
    const Vec3 normal = (polygon[1].place - polygon[0].place).cross(polygon[2].place - polygon[0].place);
    if (normal.norm() == 0) return {};
    put_in_order(polygon, normal.normalized());
    return polygon;
}

} // namespace

void add_crosses(Scene& scene, const Model& model, const Shown& shown, double scale) {
    struct Cross {
        Vec3 place, values;
        Mat3 axes;
        double size; ///< of its zone
    };
    std::vector<Cross> crosses;
    double largest = 0, sizes = 0;
    each_zone(model, shown, [&](Row, Row zone) {
        Cross cross;
        cross.place = Vec3::Zero();
        for (const Row g : model.zones.gridpoints[zone]) cross.place += 0.25 * drawn_place(model, shown, g);
        if (shown.cut && (cross.place - shown.cut->origin).dot(shown.cut->normal) > 0) return;
        std::tie(cross.values, cross.axes) = principal_axes(model, zone);
        cross.size = std::cbrt(zone_volume(model, zone));
        largest = std::max(largest, cross.values.cwiseAbs().maxCoeff());
        sizes += cross.size;
        crosses.push_back(cross);
    });
    if (crosses.empty() || largest == 0) return;
    if (scale == 0) scale = 1.6 * sizes / static_cast<double>(crosses.size()) / largest;
    Layer layer;
    layer.kind = Layer::Kind::lines;
    layer.width = 1.6F;
    double low = 0, high = 0;
    for (const Cross& cross : crosses)
        for (int k = 0; k < 3; ++k) {
            const Vec3 arm = 0.5 * scale * std::abs(cross.values[k]) * cross.axes.col(k);
            const auto value = static_cast<float>(cross.values[k]);
            add_line(layer, {cross.place - arm, value}, {cross.place + arm, value});
            low = std::min(low, cross.values[k]), high = std::max(high, cross.values[k]);
        }
    push_layer(scene, std::move(layer), colour_bar("principal stress [stress]", low, high));
}

void add_iso_surfaces(Scene& scene, const Model& model, const Shown& shown, const ColourField& field,
                      const std::vector<double>& levels) {
    Colouring colouring(field);
    const auto values = at_gridpoints(model, shown, colouring);
    ColourBar bar = colouring.bar();
    auto wanted = levels;
    if (wanted.empty()) // five between the least and the greatest
        for (int k = 1; k <= 5; ++k) wanted.push_back(bar.low + (bar.high - bar.low) * k / 6);
    Layer layer;
    layer.opacity = wanted.size() > 1 ? 0.7F : 1;
    each_zone(model, shown, [&](Row, Row zone) {
        std::array<Corner, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) {
            const Row g = model.zones.gridpoints[zone][k];
            corners[k] = {drawn_place(model, shown, g), values[static_cast<std::size_t>(g)]};
        }
        for (const double level : wanted) {
            Polygon polygon = level_in(corners, level);
            if (shown.cut) polygon = kept_part(polygon, *shown.cut);
            add_polygon(layer, polygon);
        }
    });
    push_layer(scene, std::move(layer), std::move(bar));
}

} // namespace kaya
