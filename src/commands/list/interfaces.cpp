#include "commands/list/interfaces.hpp"

#include "commands/list/model_strengths.hpp"
#include "laws/property_roles.hpp"
#include "model/measure/overlap_rows.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>

namespace kaya {
namespace {

/// The block with the lowest number of each body.
std::vector<Row> leaders(const Model& model) {
    const auto& blocks = model.blocks;
    std::map<std::int32_t, Row> of_body;
    std::vector<Row> leader(blocks.size());
    for (Row b = 0; b < static_cast<Row>(blocks.size()); ++b) {
        leader[b] = b;
        if (blocks.body[b] == 0) continue;
        const auto [first, fresh] = of_body.emplace(blocks.body[b], b);
        if (!fresh && blocks.number[b] < blocks.number[first->second]) first->second = b;
    }
    for (Row b = 0; b < static_cast<Row>(blocks.size()); ++b)
        if (blocks.body[b] != 0) leader[b] = of_body.at(blocks.body[b]);
    return leader;
}

struct Wrench {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero(); ///< about the contact's position
};

/// Of a contact on its second block, as it acts in the equations of motion.
Wrench wrench_of(const Model& model, Row contact) {
    const auto& contacts = model.contacts;
    const auto& points = model.sub_contacts;
    const Span span = contacts.sub_contacts[contact];
    const Vec3 normal = contacts.normal[contact], origin = contacts.position[contact];
    Wrench wrench;
    double by_law = 0;
    for (Row s = span.first; s < span.end(); ++s) {
        by_law += points.normal_force[s];
        const double pressure = points.pore_pressure[s] * wet_area(model, contact, s);
        const Vec3 along = Vec3(points.shear_force[s]) + Vec3(points.dashpot_shear[s]),
                   across = (points.normal_force[s] + pressure + points.dashpot_normal[s]) * normal;
        wrench.force += across + along;
        wrench.moment += (points.position[s] - origin).cross(across) + (points.shear_place(s) - origin).cross(along);
    }
    wrench.moment += contacts.twist[contact] * by_law * normal;
    return wrench;
}

/// The joint model of a contact; null where it has none.
const JointModel* model_of(const Model& model, const JointRegistry& joints, Row contact) {
    const Row row = model.contacts.properties[contact];
    return row == no_row ? nullptr : joints.find(model.joint_properties[static_cast<std::size_t>(row)].model);
}

} // namespace

std::optional<double> utilisation_of(const Model& model, const JointRegistry& joints, const Interface& one) {
    constexpr double degree = std::numbers::pi / 180;
    const auto& subs = model.sub_contacts;
    double strength = 0;
    for (const Row contact : one.contacts) {
        const JointModel* law = model_of(model, joints, contact);
        if (law == nullptr || !find_role(*law, KAYA_JROLE_FRICTION)) return std::nullopt;
        const Span span = model.contacts.sub_contacts[contact];
        for (Row s = span.first; s < span.end(); ++s) {
            const auto row = row_strength(model, *law, s);
            if (!row) return std::nullopt;
            if (is_unloaded(model, contact, s)) continue;
            const double friction = std::max(0.0, subs.normal_force[s]) * std::tan(row->friction * degree),
                         carried = Vec3(subs.shear_force[s]).norm();
            // A joint that becomes weaker as it slips carries more than it does in the end.
            strength += std::max(friction + subs.area[s] * row->cohesion, subs.state[s] != 0 ? carried : 0);
        }
    }
    if (!(strength > 0)) return std::nullopt;
    return one.shear_force() / strength;
}

Vec3 Interface::point_of_action() const {
    constexpr double along_the_plane = 1e-6;
    const double size = force.squaredNorm();
    if (!(std::abs(normal_force()) > along_the_plane * force.norm())) return centre;
    const Vec3 on_line = force.cross(moment) / size; // from the centre
    return centre + on_line - on_line.dot(normal) / normal_force() * force;
}

std::vector<Interface> interfaces_of(const Model& model, const std::vector<Row>& rows) {
    const auto& contacts = model.contacts;
    const std::vector<Row> leader = leaders(model);
    std::map<std::pair<std::int32_t, std::int32_t>, Interface> found;
    const auto turned = [&](const Interface& one, Row contact) {
        return leader[contacts.block1[contact]] == one.first ? 1.0 : -1.0;
    };
    for (const Row contact : rows) {
        Row a = leader[contacts.block1[contact]], b = leader[contacts.block2[contact]];
        if (a == b) continue;
        if (model.blocks.number[b] < model.blocks.number[a]) std::swap(a, b);
        Interface& one = found[{model.blocks.number[a], model.blocks.number[b]}];
        one.first = a;
        one.second = b;
        one.contacts.push_back(contact);
        one.area += contacts.area[contact];
        one.normal += contacts.area[contact] * turned(one, contact) * contacts.normal[contact];
        one.centre += contacts.area[contact] * contacts.position[contact];
    }
    std::vector<Interface> result;
    for (auto& [numbers, one] : found) {
        if (one.area > 0) one.centre /= one.area;
        else one.centre = contacts.position[one.contacts.front()];
        if (!(one.normal.norm() > 0))
            one.normal = turned(one, one.contacts.front()) * contacts.normal[one.contacts.front()];
        one.normal.normalize();
        for (const Row contact : one.contacts) {
            const Wrench wrench = wrench_of(model, contact);
            const double sign = turned(one, contact);
            const Vec3 arm = contacts.position[contact] - one.centre;
            one.force += sign * wrench.force;
            one.moment += sign * (wrench.moment + arm.cross(wrench.force));
        }
        result.push_back(std::move(one));
    }
    return result;
}

} // namespace kaya
