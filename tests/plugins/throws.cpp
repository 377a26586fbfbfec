// Throws from every function of the interface that is called after loading.
#include "tests/plugins/plugin.hpp"

#include <stdexcept>

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("throws");
    model.run = [](kaya_jbatch*) -> ptrdiff_t { throw std::runtime_error("the table of wear is empty"); };
    model.initialise = [](kaya_jbatch*) -> ptrdiff_t { throw 7; };
    model.check = [](const double*) -> const char* { throw std::runtime_error("no table"); };
    model.max_stiffness = [](const double*, double*, double*) { throw std::runtime_error("no table"); };
    return &model;
}
