// Directions of joints on an equal-area net. Schmidt's projection of the lower hemisphere: a direction with plunge p is at the distance
// sqrt(2) sin(45 - p/2) from the centre.
#include "model/measure/measure.hpp"
#include "pictures/model_picture.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace kaya {

std::array<double, 2> on_net(const Vec3& direction) {
    Vec3 down = direction.normalized();
    if (down.z() > 0) down = -down;
    // (x, y) of length cos p, times sqrt(2) sin(45 - p/2) / cos p = 1 / sqrt(1 + sin p).
    const double factor = 1 / std::sqrt(1 - down.z());
    return {factor * down.x(), factor * down.y()};
}

Chart direction_net(const NamedDirections& sets, const std::string& title) {
    Chart chart;
    chart.net = true;
    chart.title = title + " (north on top)";
    chart.x_label = "lower hemisphere, equal areas";
    for (const auto& [name, directions] : sets) {
        Curve& curve = chart.curves.emplace_back();
        curve.marks = true;
        curve.name = fmt::format("{} ({})", name, directions.size());
        for (const Vec3& direction : directions) {
            const auto [x, y] = on_net(direction);
            curve.x.push_back(x), curve.y.push_back(y);
        }
    }
    return chart;
}

Chart joint_net(const Model& model, const Shown& shown, bool slip) {
    const auto& contacts = model.contacts;
    std::map<std::int32_t, std::vector<Vec3>> sets;
    for (Row contact = 0; contact < static_cast<Row>(contacts.size()); ++contact) {
        if (contacts.face1[contact] == no_row || contacts.face2[contact] == no_row) continue;
        if (!std::ranges::binary_search(shown.blocks, contacts.block1[contact]) ||
            !std::ranges::binary_search(shown.blocks, contacts.block2[contact]))
            continue;
        Vec3 direction = face_area_vector(model, contacts.face1[contact]);
        if (slip) {
            direction = Vec3::Zero();
            const Span span = contacts.sub_contacts[contact];
            for (Row row = span.first; row < span.end(); ++row) direction += model.sub_contacts.shear_displacement[row];
        }
        if (!direction.allFinite() || direction.norm() == 0) continue;
        sets[contacts.joint_set[contact]].push_back(direction);
    }
    constexpr std::size_t most_names = 12; // that fit beside the net
    NamedDirections named;
    if (sets.size() > most_names) named.push_back({fmt::format("{} joint sets", sets.size()), {}});
    for (const auto& [set, directions] : sets) {
        if (sets.size() <= most_names)
            named.push_back({set == 0 ? "no joint set" : fmt::format("joint set {}", set), {}});
        auto& in = named.back().second;
        in.insert(in.end(), directions.begin(), directions.end());
    }
    return direction_net(named, slip ? "Directions of slip" : "Poles of joints");
}

} // namespace kaya
