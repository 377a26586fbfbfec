// The largest numbers of properties, history variables and states.
#include "tests/plugins/plugin.hpp"

#include <string>
#include <vector>

namespace {

std::vector<std::string> names(const char* stem, size_t count) {
    std::vector<std::string> all;
    for (size_t k = 0; k < count; ++k) all.push_back(stem + std::to_string(k + 1));
    return all;
}

/// The last property is the stiffness, the last history variable counts the steps, the last state is set.
ptrdiff_t initialise(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i)
        batch->normal_stiffness[i] = batch->shear_stiffness[i] = batch->properties[KAYA_JMODEL_MAX_PROPERTIES - 1];
    return -1;
}

ptrdiff_t run(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) {
        batch->normal_force[i] -=
            batch->properties[KAYA_JMODEL_MAX_PROPERTIES - 1] * batch->area[i] * batch->normal_disp_inc[i];
        batch->history[KAYA_JMODEL_MAX_HISTORY - 1][i] += 1;
        batch->state[i] |= 1u << (KAYA_JMODEL_MAX_STATES - 1);
    }
    return -1;
}

void max_stiffness(const double* values, double* normal, double* shear) {
    *normal = *shear = values[KAYA_JMODEL_MAX_PROPERTIES - 1];
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static const auto property_names = names("p", KAYA_JMODEL_MAX_PROPERTIES),
                      kept = names("h", KAYA_JMODEL_MAX_HISTORY), bits = names("s", KAYA_JMODEL_MAX_STATES);
    static std::vector<kaya_jproperty> properties;
    static std::vector<kaya_jhistory> history;
    static std::string states;
    static kaya_jmodel model = plugin::working("many-properties");
    if (properties.empty()) {
        for (const auto& name : property_names) properties.push_back({name.c_str(), "", "-", "", 1, 0, INFINITY, 0});
        for (const auto& name : kept) history.push_back({name.c_str(), "-", ""});
        for (const auto& name : bits) states += name + " ";
        model.properties = properties.data();
        model.property_count = properties.size();
        model.history = history.data();
        model.history_count = history.size();
        model.state_names = states.c_str();
        model.initialise = initialise;
        model.run = run;
        model.max_stiffness = max_stiffness;
    }
    return &model;
}
