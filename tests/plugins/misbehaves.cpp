// Fails as its property says, in the row given by normal_disp of row 0.
#include "tests/plugins/plugin.hpp"

#include <cstdio>

namespace {

ptrdiff_t misbehave(kaya_jbatch* batch) {
    const auto row = static_cast<size_t>(batch->normal_disp[0]);
    switch (static_cast<int>(batch->properties[0])) {
    case 0: batch->normal_force[row] = NAN; break;
    case 1: batch->shear_force[2][row] = INFINITY; break;
    case 2: batch->normal_stiffness[row] = -1; break;
    case 3: batch->history[0][row] = NAN; break;
    case 4: return static_cast<ptrdiff_t>(batch->n) + 9;
    case 5: return -2;
    case 6: return static_cast<ptrdiff_t>(row);
    case 7:
        std::snprintf(batch->message, sizeof batch->message, "the wear table ends at %g", 0.5);
        return static_cast<ptrdiff_t>(row);
    case 8:
        for (char& c : batch->message) c = 'x'; // no closing zero
        return static_cast<ptrdiff_t>(row);
    case 9: batch->shear_stiffness[row] = -0.0; break;
    case 10: batch->frictional_work[row] = NAN; break;
    }
    return -1;
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("misbehaves");
    model.run = misbehave;
    return &model;
}
