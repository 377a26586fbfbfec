// Ends the program in its 50th step: by exit(), or by _exit() if its stiffness is odd.
#include "tests/plugins/plugin.hpp"

#include <cstdlib>
#include <unistd.h>

namespace {

ptrdiff_t run(kaya_jbatch* batch) {
    if (batch->history[0][0] > 50) {
        if (std::fmod(batch->properties[0], 2) == 1) _exit(0);
        std::exit(0);
    }
    return plugin::push(batch);
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("exits-in-run");
    model.run = run;
    return &model;
}
