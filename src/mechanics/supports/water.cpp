// Water pressure in joints: docs/theory/loads.md.
#include "base/reduce.hpp"
#include "mechanics/supports/water.hpp"
#include "model/measure/joint_water.hpp"
#include "model/measure/overlap_rows.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace kaya {

namespace {

/// A second moment of a joint below this part of the other one is rounding: no pressure varies across a line.
constexpr double rounding = 1e-12;

/// Pressure at one side of a joint, from the adjacent gridpoints.
double pressure_next_to(const WaterPressure& water, const Attachment& side) {
    double sum = 0;
    if (side.attached())
        for (int k = 0; k < 3; ++k) sum += side.weights[k] * water.at_gridpoint(side.gridpoints[k]);
    return sum;
}

/// Whether the water may end within a joint: it does within one of its faces.
bool may_end_within(const Model& model, const WaterPressure& water, Row contact) {
    const Row face = model.contacts.face1[contact];
    if (face == no_row || model.contacts.face2[contact] == no_row) return false;
    bool wet = false, dry = false;
    const Span span = model.faces.triangles[face];
    for (Row t = span.first; t < span.end(); ++t)
        for (const Row g : model.triangles.gridpoints[t]) {
            const double pressure = water.unlimited_at(model.gridpoints.position[g]);
            wet = wet || pressure > 0;
            dry = dry || pressure < 0;
        }
    return wet && dry;
}

/// Places and directions in the plane of a joint, seen from one of its places.
struct JointPlane {
    Eigen::Matrix<double, 3, 2> axes;
    Vec3 origin;

    JointPlane(const Vec3& normal, const Vec3& from) : origin(from) {
        axes.col(0) = normal.unitOrthogonal();
        axes.col(1) = normal.cross(axes.col(0));
    }
    Eigen::Vector2d arm(const Vec3& place) const { return axes.transpose() * (place - origin); }
};

/// The slope s of J s = moment; none along a line that has no second moment.
Eigen::Vector2d slope_of(const Eigen::Matrix2d& second, const Eigen::Vector2d& moment) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(second);
    const double most = eigen.eigenvalues().cwiseAbs().maxCoeff();
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
    for (int k = 0; k < 2; ++k) {
        const Eigen::Vector2d axis = eigen.eigenvectors().col(k);
        if (std::abs(eigen.eigenvalues()[k]) > rounding * most)
            slope += axis.dot(moment) / eigen.eigenvalues()[k] * axis;
    }
    return slope;
}

/// Sums over an area of a joint.
struct AreaSums {
    double area = 0, force = 0;
    Eigen::Vector2d first = Eigen::Vector2d::Zero(), moment = first;
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();

    Eigen::Vector2d middle() const { return first / area; }
    Eigen::Matrix2d second_about_middle() const { return second - first * first.transpose() / area; }
};

/// The common area of the faces, with the force and the moment of the water on its wet part.
AreaSums sums_of_wet_part(const Model& model, const WaterPressure& water, Row contact, const JointPlane& plane) {
    AreaSums sums;
    for (const auto& polygon : joint_polygons(model, contact)) {
        each_third(polygon, [&](double part, const Vec3& place) {
            const Eigen::Vector2d arm = plane.arm(place);
            sums.area += part;
            sums.first += part * arm;
            sums.second += part * arm * arm.transpose();
        });
        push_water(polygon, water, [&](double part, const Vec3& place) {
            sums.force += part;
            sums.moment += part * plane.arm(place);
        });
    }
    return sums;
}

/// The area of the sub-contacts, with the force and the moment of the pressure at their places of loads. Forces act at their positions.
AreaSums sums_of_rows(const Model& model, const WaterPressure& water, Row contact, const JointPlane& plane) {
    AreaSums sums;
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[contact];
    for (Row s = span.first; s < span.end(); ++s) {
        const double area = wet_area(model, contact, s), push = area * water.at(subs.load_place(s));
        const Eigen::Vector2d arm = plane.arm(subs.position[s]);
        sums.area += area;
        sums.first += area * arm;
        sums.second += area * arm * plane.arm(subs.load_place(s)).transpose();
        sums.force += push;
        sums.moment += push * arm;
    }
    return sums;
}

/// Beside zones, from where the pressure of a joint is continued: it moves with the sub-contacts.
Vec3 first_place(const Model& model, Row contact) {
    return model.sub_contacts.position[model.contacts.sub_contacts[contact].first];
}

/// Finds the pressure, linear over the joint, that gives it the force and the moment of the water on the wet part of the common area of the faces: all of
/// the pressure of a joint of rigid blocks, whose places change as it opens, and beside zones what the places lack.
void find_end_of_water(Model& model, const WaterPressure& water, Row contact) {
    auto& contacts = model.contacts;
    const bool rigid = between_rigid(model, contact);
    const JointPlane plane(contacts.normal[contact], contacts.position[contact]);
    const AreaSums wet = sums_of_wet_part(model, water, contact, plane);
    const AreaSums there = rigid ? wet : sums_of_rows(model, water, contact, plane);
    if (!(wet.area > 0) || !(wet.force > 0) || !(there.area > 0)) return;
    const double force = rigid ? wet.force : wet.force - there.force;
    const Eigen::Vector2d moment = rigid ? wet.moment : wet.moment - there.moment;
    const Eigen::Vector2d slope = slope_of(there.second_about_middle(), moment - force * there.middle());
    contacts.water_slope[contact] = plane.axes * slope;
    const Vec3 from = plane.origin + plane.axes * there.middle(),
               to = rigid ? model.blocks.centroid[contacts.block1[contact]] : first_place(model, contact);
    contacts.water_pressure[contact] = force / there.area + contacts.water_slope[contact].dot(to - from);
}

bool ends_within(const Contacts& contacts, Row contact) {
    return contacts.water_pressure[contact] != 0 || !contacts.water_slope[contact].isZero(0);
}

/// Pressures p_i of gridpoints, whose shape functions have their forces at the places of loads, at an arm a_i from those of the sub-contacts:
/// adds s . a_i, which has no force and gives the joint the moment. Exact at each place where the pressure is linear over the joint.
void move_to_places_of_loads(Model& model, Row contact) {
    auto& subs = model.sub_contacts;
    const JointPlane plane(model.contacts.normal[contact], first_place(model, contact));
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
    const Span span = model.contacts.sub_contacts[contact];
    for (Row s = span.first; s < span.end(); ++s) {
        const Eigen::Vector2d arm = plane.axes.transpose() * Vec3(subs.load_arm[s]);
        moment += subs.area[s] * subs.pore_pressure[s] * arm;
        second += subs.area[s] * arm * plane.arm(subs.position[s]).transpose();
    }
    if (moment.isZero(0)) return; // dry
    const Vec3 slope = plane.axes * slope_of(0.5 * (second + second.transpose()), moment);
    for (Row s = span.first; s < span.end(); ++s) subs.pore_pressure[s] += slope.dot(Vec3(subs.load_arm[s]));
}

} // namespace

void find_ends_of_water(Model& model) {
    auto& contacts = model.contacts;
    if (model.settings.water == Water::none) return;
    const WaterPressure water(model);
    for_chunks(contacts.size(), 256, [&](std::size_t first, std::size_t last) {
        for (auto c = static_cast<Row>(first); c < static_cast<Row>(last); ++c) {
            contacts.water_pressure[c] = 0;
            contacts.water_slope[c].setZero();
            if (water.is_linear() && may_end_within(model, water, c)) find_end_of_water(model, water, c);
        }
    });
}

void put_water(Model& model) {
    if (model.settings.water == Water::none) return;
    const WaterPressure water(model);
    const auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    if (model.settings.water == Water::points) {
        for_chunks(subs.size(), 4096, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                subs.pore_pressure[i] = std::max(
                    0.0, 0.5 * (pressure_next_to(water, subs.side1[i]) + pressure_next_to(water, subs.side2[i])));
        });
        if (!subs.keeps_load_arms) return;
        for_chunks(contacts.size(), 256, [&](std::size_t first, std::size_t last) {
            for (auto c = static_cast<Row>(first); c < static_cast<Row>(last); ++c)
                if (!between_rigid(model, c)) move_to_places_of_loads(model, c);
        });
        return;
    }
    for_chunks(subs.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            subs.pore_pressure[i] = water.at(subs.load_place(static_cast<Row>(i)));
    });
    for_chunks(contacts.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (auto c = static_cast<Row>(first); c < static_cast<Row>(last); ++c) {
            if (!ends_within(contacts, c)) continue;
            const bool rigid = between_rigid(model, c);
            const Vec3 origin = rigid ? Vec3(model.blocks.centroid[contacts.block1[c]]) : first_place(model, c);
            const Span span = contacts.sub_contacts[c];
            for (Row s = span.first; s < span.end(); ++s) {
                const double linear =
                    contacts.water_pressure[c] + contacts.water_slope[c].dot(subs.load_place(s) - origin);
                subs.pore_pressure[s] = rigid ? linear : subs.pore_pressure[s] + linear;
            }
        }
    });
}

} // namespace kaya
