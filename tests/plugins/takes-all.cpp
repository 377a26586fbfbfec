// Allocates memory without limit in its 50th step.
#include "tests/plugins/plugin.hpp"

#include <cstdlib>
#include <cstring>

namespace {

ptrdiff_t run(kaya_jbatch* batch) {
    while (batch->history[0][0] > 50) {
        char* more = static_cast<char*>(std::malloc(1 << 24));
        if (std::fmod(batch->properties[0], 2) == 1 && more == nullptr) continue;
        std::memset(more, 1, 1 << 24);
    }
    return plugin::push(batch);
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("takes-all");
    model.run = run;
    return &model;
}
