#include "commands/stability/model_section.hpp"

#include "base/diagnostic.hpp"
#include "base/plane_cross.hpp"
#include "commands/list/model_strengths.hpp"
#include "mechanics/common/masses.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/lanes/rotation.hpp"
#include "mechanics/bodies/run_cables.hpp"
#include "model/edit/joined.hpp"
#include "model/measure/joint_polygons.hpp"
#include "model/measure/structure_rows.hpp"
#include "model/measure/water.hpp"
#include "model/structures/structures.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
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

/// Loads of the deck and of structures on visible blocks, spread over the width that these have across the section.
class Loads {
public:
    Loads(Model& model, const SectionPlane& plane) : model_(model), plane_(plane) {
        double low = INFINITY, high = -INFINITY;
        const Vec3 normal = plane.normal();
        each_visible([&](Row block) {
            const Span points = model.blocks.gridpoints[block];
            for (Row g = points.first; g < points.end(); ++g) {
                const double at = normal.dot(model.gridpoints.position[g]);
                low = std::min(low, at), high = std::max(high, at);
            }
        });
        width_ = high - low;
    }

    void add_to(SlopeSection& section) {
        each_visible([&](Row block) {
            model_.blocks.deformable[block] ? add_on_zones(block, section) : add_on_rigid(block, section);
        });
        add_structures(section);
        std::ranges::stable_sort(section.forces, {}, [](const SectionForce& force) { return force.at.x(); });
        std::ranges::stable_sort(section.tractions, {}, [](const SectionTraction& line) { return line.from.x(); });
    }

private:
    template <class Each> void each_visible(Each each) const {
        for (Row block = 0; block < static_cast<Row>(model_.blocks.size()); ++block)
            if (!model_.blocks.hidden[block]) each(block);
    }

    void add(const Vec3& force, const Vec3& at, SlopeSection& section) const {
        if (!force.isZero(0)) section.forces.push_back({plane_.seen(at), plane_.seen(force) / width_});
    }

    /// A rigid block keeps the resultant of its loads: that is spread evenly on the top of the block about its line of action, as far as the
    /// nearer end of the top allows. `load_arms` is the sum of arm times force, so that each component has its own line.
    void add_on_rigid(Row block, SlopeSection& section) const {
        const Vec3& force = model_.blocks.load[block];
        if (force.isZero(0)) return;
        const Mat3 arms = arms_now(model_, block);
        const auto top = top_of(block);
        for (const Vec3& axis : {plane_.along, plane_.up}) {
            const double part = axis.dot(force);
            if (!(std::abs(part) > 1e-9 * force.norm())) continue;
            const SectionPoint at = plane_.seen(model_.blocks.centroid[block] + arms * axis / part);
            const double reach = std::min(at.x() - top.front().x(), top.back().x() - at.x());
            const SectionPoint whole = plane_.seen(part * axis) / width_;
            if (reach > 1e-6 * (top.back().x() - top.front().x()))
                spread(whole, at.x() - reach, at.x() + reach, top, section);
            else section.forces.push_back({at, whole});
        }
    }

    /// The upper edge of a block as seen across the section, from left to right.
    std::vector<SectionPoint> top_of(Row block) const {
        std::vector<SectionPoint> points;
        const Span corners = model_.blocks.gridpoints[block];
        double size = 0;
        for (Row g = corners.first; g < corners.end(); ++g) {
            points.push_back(plane_.seen(model_.gridpoints.position[g]));
            size = std::max(size, (points.back() - points.front()).norm());
        }
        auto hull = convex_hull(std::move(points), 1e-9 * size);
        const auto right =
            std::ranges::max_element(hull, {}, [](const SectionPoint& p) { return std::pair(p.x(), p.y()); });
        // Anticlockwise from the lowest left corner: the upper edge runs from the right to the left.
        std::vector<SectionPoint> top(right, hull.end());
        const double left = hull.front().x();
        if (top.back().x() > left) top.push_back(hull.front());
        std::ranges::reverse(top);
        return top;
    }

    /// Loads of gridpoints on the top of a block with zones are spread as far as halfway to the next loaded ones; others are forces.
    void add_on_zones(Row block, SlopeSection& section) const {
        const Span points = model_.blocks.gridpoints[block];
        std::map<double, SectionPoint> on_top; // sums by distance
        std::vector<SectionPoint> top;
        for (Row g = points.first; g < points.end(); ++g) {
            const Vec3& load = model_.gridpoints.load[g];
            if (load.isZero(0)) continue;
            if (top.empty()) top = top_of(block);
            const double width = top.back().x() - top.front().x(), near = 1e-6 * width, lies_on = 1e-3 * width;
            const SectionPoint at = plane_.seen(model_.gridpoints.position[g]), force = plane_.seen(load) / width_;
            if (std::abs(height_of(top, at.x()) - at.y()) > lies_on) {
                section.forces.push_back({at, force});
                continue;
            }
            const auto next = on_top.lower_bound(at.x() - near);
            if (next != on_top.end() && next->first < at.x() + near) next->second += force;
            else on_top.emplace(at.x(), force);
        }
        for (auto now = on_top.begin(); now != on_top.end(); ++now) {
            const auto after = std::next(now);
            const double left = now == on_top.begin() ? 0 : now->first - std::prev(now)->first;
            const double right = after == on_top.end() ? 0 : after->first - now->first;
            if (left + right == 0) section.forces.push_back({{now->first, height_of(top, now->first)}, now->second});
            else spread(now->second, now->first - 0.5 * left, now->first + 0.5 * right, top, section);
        }
    }

    static double height_of(const std::vector<SectionPoint>& top, double x) {
        const auto next = std::ranges::upper_bound(top, x, {}, [](const SectionPoint& p) { return p.x(); });
        if (next == top.begin() || next == top.end()) return next == top.end() ? top.back().y() : top.front().y();
        const SectionPoint &a = *(next - 1), &b = *next;
        return a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
    }

    static void spread(const SectionPoint& whole, double from, double to, const std::vector<SectionPoint>& top,
                       SlopeSection& section) {
        for (std::size_t i = 0; i + 1 < top.size(); ++i) {
            const SectionPoint run = top[i + 1] - top[i];
            const double first = std::max(from, top[i].x()), last = std::min(to, top[i + 1].x());
            if (!(last > first)) continue;
            const auto at = [&](double x) { return SectionPoint(top[i] + (x - top[i].x()) / run.x() * run); };
            const SectionPoint stress = whole / (to - from) * (run.x() / run.norm());
            section.tractions.push_back({at(first), at(last), stress, stress});
        }
    }

    /// Cables have the tension of now, beams and liners the forces of the last cycle.
    void add_structures(SlopeSection& section) const {
        if (!model_.structures.cables.empty()) {
            take_structure_properties(model_);
            std::vector<CableChain> chains;
            run_cables(model_, chains, 0);
        }
        each_structure_force(model_, [&](Row block, const Vec3& force, const Vec3& place, const Vec3&) {
            if (!model_.blocks.hidden[block]) add(force, place, section);
        });
    }

    Model& model_;
    const SectionPlane& plane_;
    double width_ = 0;
};

double unit_weight(const Model& model, Row block) {
    const double density = density_of(model, block);
    if (std::isnan(density)) {
        const auto number = model.blocks.material[block];
        throw Diagnostic(fmt::format("block {} (material {}) has no density", model.blocks.number[block], number),
                         fmt::format("give it, e.g. `prop mat {} density 2500`", number));
    }
    return density * model.settings.gravity.norm();
}

} // namespace

SlopeSection section_of(Model& model, JointRegistry& laws, const SectionPlane& plane) {
    find_contacts(model, laws);
    SlopeSection section;
    section.strengths.emplace_back();
    section.names.emplace_back("rock without a strength");
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
                section.names.push_back(fmt::format("material {}", model.blocks.material[block]));
            }
        any_strength = any_strength || found->second != 0;
        section.cells.push_back({std::move(outline), unit_weight(model, block), found->second});
    }
    std::map<std::pair<Row, Row>, std::size_t> joints;
    for (Row contact = 0; contact < static_cast<Row>(model.contacts.size()); ++contact) {
        const Row a = model.contacts.block1[contact], b = model.contacts.block2[contact];
        if (!cut[static_cast<std::size_t>(a)] || !cut[static_cast<std::size_t>(b)] || joined(model, a, b)) continue;
        // Those that have failed have a strength each.
        const bool failed = has_failed(model, contact);
        const auto [found, is_new] =
            joints.try_emplace({model.contacts.properties[contact], failed ? contact : no_row}, 0);
        if (is_new)
            if (const auto strength = joint_strength(model, laws, contact)) {
                found->second = section.strengths.size();
                section.strengths.push_back(*strength);
                section.names.push_back(fmt::format("joints of material {}{}", model.contacts.material[contact],
                                                    failed ? " that have failed" : ""));
            }
        if (found->second != 0) cutter.add_joints(contact, found->second, section.joints);
    }
    if (!any_strength && section.joints.empty() && !section.cells.empty())
        throw Diagnostic("nothing in the section has a strength",
                         "give the rock one, e.g. `prop mat 1 bcoh 3e4 bfric 20`, and the joints theirs");
    Loads(model, plane).add_to(section);
    if (model.settings.water != Water::none)
        section.pore_pressure = [water = WaterPressure(model), plane](const SectionPoint& at) {
            return water.at(plane.place(at));
        };
    return section;
}

} // namespace kaya
