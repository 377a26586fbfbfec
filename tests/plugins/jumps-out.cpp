// Calls longjmp to a frame that has returned, in its 50th step.
#include "tests/plugins/plugin.hpp"

#include <csetjmp>

namespace {

std::jmp_buf place;
bool known = false;

[[gnu::noinline]] bool deeper(int depth) {
    volatile char room[256];
    room[0] = static_cast<char>(depth);
    if (depth == 0) {
        if (setjmp(place) == 0) return false;
        return true;
    }
    return deeper(depth - 1) || room[0] == 77;
}

ptrdiff_t run(kaya_jbatch* batch) {
    if (!known && batch->history[0][0] > 20) {
        known = true;
        deeper(static_cast<int>(batch->properties[0]) % 10);
    }
    if (batch->history[0][0] > 50) std::longjmp(place, 1);
    return plugin::push(batch);
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("jumps-out");
    model.run = run;
    return &model;
}
