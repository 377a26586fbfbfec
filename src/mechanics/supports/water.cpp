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

/// The pressure, linear over the joint, that has the force and the moment of the water on the wet part of the common area of the faces.
void find_end_of_water(Model& model, const WaterPressure& water, Row contact) {
    auto& contacts = model.contacts;
    Eigen::Matrix<double, 3, 2> plane;
    plane.col(0) = contacts.normal[contact].unitOrthogonal();
    plane.col(1) = contacts.normal[contact].cross(plane.col(0));
    const Vec3 origin = contacts.position[contact];
    const auto arm_of = [&](const Vec3& place) -> Eigen::Vector2d { return plane.transpose() * (place - origin); };
    double area = 0, force = 0;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero(), moment = middle;
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
    for (const auto& polygon : joint_polygons(model, contact)) {
        each_third(polygon, [&](double part, const Vec3& place) {
            const Eigen::Vector2d arm = arm_of(place);
            area += part;
            middle += part * arm;
            second += part * arm * arm.transpose();
        });
        push_water(polygon, water, [&](double part, const Vec3& place) {
            force += part;
            moment += part * arm_of(place);
        });
    }
    if (!(area > 0) || !(force > 0)) return;
    middle /= area;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(second - area * middle * middle.transpose());
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
    for (int k = 0; k < 2; ++k) {
        const Eigen::Vector2d axis = axes.eigenvectors().col(k);
        if (axes.eigenvalues()[k] > rounding * axes.eigenvalues()[1])
            slope += axis.dot(moment - force * middle) / axes.eigenvalues()[k] * axis;
    }
    contacts.water_slope[contact] = plane * slope;
    const Vec3 from = origin + plane * middle, to = model.blocks.centroid[contacts.block1[contact]];
    contacts.water_pressure[contact] = force / area + contacts.water_slope[contact].dot(to - from);
}

bool ends_within(const Contacts& contacts, Row contact) {
    return contacts.water_pressure[contact] != 0 || !contacts.water_slope[contact].isZero(0);
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
            if (water.is_linear() && between_rigid(model, c) && may_end_within(model, water, c))
                find_end_of_water(model, water, c);
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
        return;
    }
    for_chunks(subs.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            subs.pore_pressure[i] = water.at(subs.load_place(static_cast<Row>(i)));
    });
    for_chunks(contacts.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (auto c = static_cast<Row>(first); c < static_cast<Row>(last); ++c) {
            if (!ends_within(contacts, c)) continue;
            const Vec3 origin = model.blocks.centroid[contacts.block1[c]];
            const Span span = contacts.sub_contacts[c];
            for (Row s = span.first; s < span.end(); ++s)
                subs.pore_pressure[s] =
                    contacts.water_pressure[c] + contacts.water_slope[c].dot(Vec3(subs.position[s]) - origin);
        }
    });
}

} // namespace kaya
