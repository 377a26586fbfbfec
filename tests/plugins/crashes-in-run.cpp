// Works until a sub-contact has slipped by more than 0.1, and then fails as its property says: 1 a bad address, 2 an integer division by
// zero, 3 abort(), 4 a stack overflow.
#include "tests/plugins/plugin.hpp"

#include <csignal>
#include <cstdlib>

namespace {

// Hides the endless recursion from the compiler.
__attribute__((noinline)) int deeper(volatile int* depth) {
    volatile char room[4096];
    *depth = *depth + 1;
    room[0] = static_cast<char>(*depth);
    return *depth > 0 ? deeper(depth) + room[0] : 0;
}

void die(int way) {
    volatile int zero = 0;
    if (way == 1) *reinterpret_cast<volatile int*>(static_cast<std::size_t>(zero) + 16) = 1;
    if (way == 2) zero = 100 / zero;
    if (way == 3) std::abort();
    if (way == 4) deeper(&zero);
}

ptrdiff_t run(kaya_jbatch* batch) {
    for (batch->row = 0; batch->row < batch->n; ++batch->row) {
        const size_t i = batch->row;
        if (std::abs(batch->shear_disp[0][i]) > 0.1) die(static_cast<int>(batch->properties[1]));
        batch->normal_force[i] -= batch->properties[0] * batch->area[i] * batch->normal_disp_inc[i];
    }
    return -1;
}

constexpr kaya_jproperty two[] = {
    plugin::properties[0],
    {"way", "", "-", "in which it dies", 1, 0, 4, 0},
};

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("crashes-in-run");
    model.properties = two;
    model.property_count = 2;
    model.run = run;
    return &model;
}
