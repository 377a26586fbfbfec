#include "mechanics/contact/torn_bonds.hpp"

#include "laws/property_roles.hpp"
#include "mechanics/contact/batches.hpp"
#include "mechanics/contact/contact_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace kaya {

namespace {

constexpr Row most_bits = 32; ///< of more places, neighbours in order share one

std::uint32_t bit_of(const Model& model, Row contact, Row row) {
    const Span span = model.contacts.sub_contacts[contact];
    const std::int64_t place = row - span.first;
    return 1u << (span.count <= most_bits ? place : place * most_bits / span.count);
}

/// Whether a place, a row of the joint, has been open.
bool is_torn(const Model& model, Row contact, Row row) {
    return (model.contacts.torn[contact] & bit_of(model, contact, row)) != 0;
}

std::uint32_t all_of(const Span& span) { return span.count < most_bits ? (1u << span.count) - 1 : ~0u; }

bool has_bond(const JointModel& joint, const std::vector<double>& values) {
    for (std::size_t i = 0; i < joint.properties.size() && i < values.size(); ++i) {
        const StrengthPart part = strength_part(joint.properties[i].role);
        if ((part == StrengthPart::cohesion || part == StrengthPart::tension) && values[i] > 0) return true;
    }
    return false;
}

const std::vector<double>& values_of(const Model& model, Row contact) {
    return model.joint_properties[static_cast<std::size_t>(model.contacts.properties[contact])].values;
}

/// One row in a step in which it opens; its history agrees with its force afterwards.
void open_row(Model& model, const JointModel& joint, Row contact, Row s, double opening, BatchColumns& made) {
    auto& subs = model.sub_contacts;
    const Batch row{&joint, model.contacts.properties[contact], s, 1, {contact}};
    const double force = subs.normal_force[s], increment = subs.normal_displacement_increment[s],
                 worn = subs.frictional_work[s];
    const Vec3 shear = subs.shear_force[s], slip = subs.shear_displacement_increment[s];
    subs.normal_force[s] = 0;
    subs.shear_force.set(s, Vec3::Zero());
    subs.normal_displacement_increment[s] = opening;
    subs.shear_displacement_increment.set(s, Vec3::Zero());
    auto columns = columns_of(model, row, model.clock.time_step, made);
    if (const auto failure = run_batch(joint, columns, subs.number.data() + s, Guard::fenced))
        throw joint_failure(model, row, *failure);
    subs.normal_force[s] = force;
    subs.shear_force.set(s, shear);
    subs.frictional_work[s] = worn;
    subs.normal_displacement_increment[s] = 0;
    columns = columns_of(model, row, model.clock.time_step, made);
    if (const auto failure = initialise_batch(joint, columns, subs.number.data() + s))
        throw joint_failure(model, row, *failure);
    subs.normal_displacement_increment[s] = increment;
    subs.shear_displacement_increment.set(s, slip);
}

} // namespace

void begin_tearing(Model& model, const JointModel& joint, Row contact) {
    const auto& subs = model.sub_contacts;
    std::uint32_t& torn = model.contacts.torn[contact];
    const std::uint32_t before = torn;
    torn = 0;
    if (!has_bond(joint, values_of(model, contact))) return;
    const Span span = model.contacts.sub_contacts[contact];
    for (Row s = span.first; s < span.end(); ++s) {
        const std::uint32_t bit = bit_of(model, contact, s);
        const bool was_torn = (before & bit) != 0 && (subs.state[s] != 0 || joint.states.empty());
        if (was_torn || !(subs.normal_force[s] > 0)) torn |= bit;
    }
}

void note_torn(Model& model, Row contact) {
    std::uint32_t& torn = model.contacts.torn[contact];
    const Span span = model.contacts.sub_contacts[contact];
    const std::uint32_t all = all_of(span);
    if (torn == 0 || torn == all) return;
    const double depth = model.contacts.depth[contact];
    if (!(depth > 0)) {
        torn = all;
        return;
    }
    constexpr double rounding = 1e-9; // of the depth
    const auto& subs = model.sub_contacts;
    for (Row s = span.first; s < span.end(); ++s)
        if (!is_torn(model, contact, s) && subs.side1[s].attached() && subs.side2[s].attached() &&
            opening_on_faces(model, s) > rounding * depth)
            torn |= bit_of(model, contact, s);
}

Row row_of_majority(const Model& model, Row contact, Row most) {
    if (model.contacts.torn[contact] == 0) return most;
    struct Kind {
        Row row = no_row;
        double area = 0, traction = 0;
    };
    std::array<Kind, 2> kinds; // with a bond, and torn
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[contact];
    for (Row s = span.first; s < span.end(); ++s) {
        if (!(subs.normal_force[s] > 0)) continue;
        Kind& kind = kinds[is_torn(model, contact, s) ? 1 : 0];
        kind.area += subs.area[s];
        const double traction = subs.normal_force[s] / subs.area[s];
        if (traction <= kind.traction) continue;
        kind.traction = traction;
        kind.row = s;
    }
    const Row row = (kinds[1].area > kinds[0].area ? kinds[1] : kinds[0]).row;
    return row == no_row ? most : row;
}

void tear(Model& model, const JointModel& joint, Row contact) {
    if (model.contacts.torn[contact] == 0 || !joint.missing(values_of(model, contact)).empty()) return;
    const double opening = std::sqrt(model.contacts.area[contact]);
    const Span span = model.contacts.sub_contacts[contact];
    BatchColumns made;
    for (Row s = span.first; s < span.end(); ++s)
        if (is_torn(model, contact, s)) open_row(model, joint, contact, s, opening, made);
}

} // namespace kaya
