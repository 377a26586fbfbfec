// A sub-contact of the model as a lone row, to try its joint model on.
#pragma once

#include "laws/lone_row.hpp"
#include "model/tables/model.hpp"

namespace kaya {

/// Its increments are 0.
struct RowCopy : LoneRow {
    LoneColumns others;
    Row row = no_row; ///< it is a copy of
    const Model* of = nullptr;

    void take(const Model& model, const JointModel& joint, Row s) {
        const auto& subs = model.sub_contacts;
        row = s;
        of = &model;
        area = subs.area[s];
        normal_disp = subs.normal_displacement[s];
        pore_pressure = subs.pore_pressure[s];
        normal_force = subs.normal_force[s];
        normal_stiffness = subs.normal_stiffness[s];
        shear_stiffness = subs.shear_stiffness[s];
        frictional_work = subs.frictional_work[s];
        state = subs.state[s];
        for (int k = 0; k < 3; ++k) {
            shear_disp[k] = subs.shear_displacement.component[k][s];
            shear_force[k] = subs.shear_force.component[k][s];
        }
        for (std::size_t k = 0; k < joint.history.size(); ++k) history[k] = subs.history[k][s];
        if (joint.keeps_objects()) object = subs.object[s];
    }
    /// Fields and place of the row.
    void place(const JointModel& joint) {
        const auto& subs = of->sub_contacts;
        for (std::size_t k = 0; k < joint.fields.size() && static_cast<std::int32_t>(k) < subs.field_columns; ++k)
            if (subs.field_set[row] >> k & 1u) others.field[k] = subs.field[k][row];
        const Row c = subs.contact[row];
        const Vec3 x = subs.position[row];
        for (int k = 0; k < 3; ++k) others.position[k] = x[k], others.normal[k] = of->contacts.normal[c][k];
        others.block = {of->blocks.number[of->contacts.block1[c]], of->blocks.number[of->contacts.block2[c]]};
    }
    kaya_jbatch batch(const JointModel& joint, const std::vector<double>& values, double step) {
        const kaya_jbatch b = LoneRow::batch(joint, values, step, others);
        if (of != nullptr) place(joint);
        return b;
    }
};

} // namespace kaya
