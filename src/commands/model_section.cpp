#include "commands/model_section.hpp"

#include "base/diagnostic.hpp"
#include "base/plane_cross.hpp"
#include "commands/model_strengths.hpp"
#include "mechanics/contact_properties.hpp"
#include "model/joined.hpp"
#include "model/joint_polygons.hpp"
#include "model/water.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace kaya {

namespace {

/// Andrew's monotone chain; blocks are convex.
std::vector<SectionPoint> convex_hull(std::vector<SectionPoint> points, double near) {
    std::ranges::sort(points,
                      [](const auto& a, const auto& b) { return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y()); });
    points.erase(std::unique(points.begin(), points.end(),
                             [near](const auto& a, const auto& b) { return (a - b).norm() < near; }),
                 points.end());
    std::vector<SectionPoint> hull;
    for (int half = 0; half < 2; ++half) {
        const std::size_t start = hull.size();
        for (const auto& point : points) {
            while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0)
                hull.pop_back();
            hull.push_back(point);
        }
        if (!hull.empty()) hull.pop_back();
        std::ranges::reverse(points);
    }
    return hull;
}

class Cutter {
public:
    Cutter(const Model& model, const SectionPlane& plane) : model_(model), plane_(plane), normal_(plane.normal()) {}

    double above(const Vec3& place) const { return normal_.dot(place - plane_.point); }

    std::vector<SectionPoint> outline(Row block) const {
        const auto& points = model_.gridpoints;
        const Span corners = model_.blocks.gridpoints[block];
        double low = INFINITY, high = -INFINITY;
        for (Row g = corners.first; g < corners.end(); ++g)
            low = std::min(low, above(points.position[g])), high = std::max(high, above(points.position[g]));
        if (!(low < 0 && high > 0)) return {};
        std::vector<SectionPoint> cuts;
        const Span triangles = model_.blocks.triangles[block];
        for (Row t = triangles.first; t < triangles.end(); ++t) {
            const auto& rows = model_.triangles.gridpoints[t];
            for (int k = 0; k < 3; ++k) {
                const Vec3 &a = points.position[rows[k]], &b = points.position[rows[(k + 1) % 3]];
                const double ha = above(a), hb = above(b);
                if ((ha <= 0) == (hb <= 0)) continue;
                cuts.push_back(plane_.seen(a + ha / (ha - hb) * (b - a)));
            }
        }
        const double near = 1e-9 * (high - low + std::abs(plane_.along.dot(points.position[corners.first])));
        auto hull = convex_hull(std::move(cuts), near);
        if (hull.size() < 3) hull.clear();
        return hull;
    }

    /// The intersection of the plane with a joint: a segment for each of its convex parts.
    void add_joints(Row contact, std::size_t strength, std::vector<SectionJoint>& joints) const {
        for (const auto& polygon : joint_polygons(model_, contact)) {
            std::vector<SectionPoint> ends;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                const double ha = above(a), hb = above(b);
                if ((ha <= 0) == (hb <= 0)) continue;
                ends.push_back(plane_.seen(a + ha / (ha - hb) * (b - a)));
            }
            if (ends.size() == 2) joints.push_back({ends[0], ends[1], strength});
        }
    }

private:
    const Model& model_;
    const SectionPlane& plane_;
    Vec3 normal_;
};

double unit_weight(const Model& model, Row block) {
    const auto number = model.blocks.material[block];
    const auto material = model.materials.find(number);
    if (material == model.materials.end() || std::isnan(material->second.density))
        throw Diagnostic(fmt::format("block {} (material {}) has no density", model.blocks.number[block], number),
                         fmt::format("give it, e.g. `prop mat {} density 2500`", number));
    return material->second.density * model.settings.gravity.norm();
}

} // namespace

SlopeSection section_of(Model& model, JointRegistry& laws, const SectionPlane& plane) {
    find_contacts(model, laws);
    SlopeSection section;
    section.strengths.emplace_back();
    const Cutter cutter(model, plane);
    // Blocks of equal material and zone model share a strength.
    std::map<std::tuple<std::int32_t, std::int32_t, Row>, std::size_t> known;
    std::vector<char> cut(model.blocks.size(), 0);
    bool any_strength = false;
    for (Row block = 0; block < static_cast<Row>(model.blocks.size()); ++block) {
        if (model.blocks.hidden[block]) continue;
        auto outline = cutter.outline(block);
        if (outline.empty()) continue;
        cut[static_cast<std::size_t>(block)] = 1;
        const auto [found, is_new] = known.try_emplace(
            {model.blocks.material[block], model.blocks.constitutive[block], model.blocks.zone_properties[block]}, 0);
        if (is_new)
            if (const auto strength = rock_strength(model, laws, block)) {
                found->second = section.strengths.size();
                section.strengths.push_back(*strength);
            }
        any_strength = any_strength || found->second != 0;
        section.cells.push_back({std::move(outline), unit_weight(model, block), found->second});
    }
    std::map<Row, std::size_t> joints;
    for (Row contact = 0; contact < static_cast<Row>(model.contacts.size()); ++contact) {
        const Row a = model.contacts.block1[contact], b = model.contacts.block2[contact];
        if (!cut[static_cast<std::size_t>(a)] || !cut[static_cast<std::size_t>(b)] || joined(model, a, b)) continue;
        const auto [found, is_new] = joints.try_emplace(model.contacts.properties[contact], 0);
        if (is_new)
            if (const auto strength = joint_strength(model, laws, contact)) {
                found->second = section.strengths.size();
                section.strengths.push_back(*strength);
            }
        if (found->second != 0) cutter.add_joints(contact, found->second, section.joints);
    }
    if (!any_strength && section.joints.empty() && !section.cells.empty())
        throw Diagnostic("nothing in the section has a strength",
                         "give the rock and the joints a strength, e.g. `prop mat 1 bcoh 3e4 bfric 20`");
    if (model.settings.water != Water::none)
        section.pore_pressure = [water = WaterPressure(model), plane](const SectionPoint& at) {
            return water.at(plane.place(at));
        };
    return section;
}

} // namespace kaya
