// Uses fields, positions and block numbers, and stores the values it received.
#include "tests/plugins/plugin.hpp"

namespace {

constexpr kaya_jhistory kept[] = {{"steps", "-", ""},      {"seen-x", "length", ""}, {"seen-normal", "-", ""},
                                  {"seen-block", "-", ""}, {"seen-heat", "-", ""},   {"seen-stiffness", "-", ""}};
constexpr kaya_jfield fields[] = {{"temperature", "K", "temperature of the rock", 283},
                                  {"stiffness", "stress/length", "stiffness of both springs, where it differs", 0}};

ptrdiff_t initialise(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) batch->normal_stiffness[i] = batch->shear_stiffness[i] = batch->field[1][i];
    return -1;
}

ptrdiff_t run(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) {
        const double stiffness = batch->field[1][i];
        batch->normal_force[i] -= stiffness * batch->area[i] * batch->normal_disp_inc[i];
        batch->history[0][i] += 1;
        batch->history[1][i] = batch->position[0][i];
        batch->history[2][i] = batch->normal[2][i];
        batch->history[3][i] = 1000 * batch->block[0][i] + batch->block[1][i];
        batch->history[4][i] = batch->field[0][i];
        batch->history[5][i] = stiffness;
        if (batch->normal_stiffness[i] != stiffness) {
            batch->normal_stiffness[i] = batch->shear_stiffness[i] = stiffness;
            batch->stiffness_changed = 1;
        }
    }
    return -1;
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("sees-places");
    model.history = kept;
    model.history_count = 6;
    model.initialise = initialise;
    model.run = run;
    model.fields = fields;
    model.field_count = 2;
    model.needs = KAYA_JMODEL_NEEDS_PLACE;
    return &model;
}
