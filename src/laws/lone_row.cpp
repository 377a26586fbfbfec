#include "laws/lone_row.hpp"

namespace kaya {

void LoneColumns::add_to(kaya_jbatch& batch, const JointModel& model) {
    for (std::size_t k = 0; k < model.fields.size(); ++k) {
        const auto& f = model.fields[k];
        field[k] = f.property ? batch.properties[*f.property] : f.initial;
        fields[k] = &field[k];
    }
    if (!model.fields.empty()) batch.field = fields.data();
    if (!model.needs_place()) return;
    for (std::size_t k = 0; k < 3; ++k) batch.position[k] = &position[k], batch.normal[k] = &normal[k];
    for (std::size_t k = 0; k < 2; ++k) batch.block[k] = &block[k];
}

kaya_jbatch LoneRow::batch(const JointModel& model, const std::vector<double>& values, double time_step,
                           LoneColumns& others) {
    for (std::size_t k = 0; k < history.size(); ++k) others.history[k] = &history[k];
    kaya_jbatch b{};
    b.n = 1;
    b.properties = values.data();
    b.time_step = time_step;
    b.area = &area;
    b.normal_disp = &normal_disp;
    b.normal_disp_inc = &normal_disp_inc;
    for (std::size_t k = 0; k < 3; ++k) {
        b.shear_disp[k] = &shear_disp[k];
        b.shear_disp_inc[k] = &shear_disp_inc[k];
        b.shear_force[k] = &shear_force[k];
    }
    b.pore_pressure = &pore_pressure;
    b.normal_force = &normal_force;
    b.normal_stiffness = &normal_stiffness;
    b.shear_stiffness = &shear_stiffness;
    b.frictional_work = &frictional_work;
    b.state = &state;
    b.history = others.history.data();
    b.object = model.keeps_objects() ? object.address() : nullptr;
    b.tables = model.tables;
    others.add_to(b, model);
    return b;
}

} // namespace kaya
