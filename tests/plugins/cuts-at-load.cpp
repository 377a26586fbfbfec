// Like a library linked with -ffast-math: denormal numbers are flushed to 0 after loading.
#include "tests/plugins/plugin.hpp"

#if defined(__SSE2__)
#include <xmmintrin.h>

__attribute__((constructor)) static void cut_small_numbers() { _mm_setcsr(_mm_getcsr() | 0x8040); }
#endif

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("cuts-at-load");
    return &model;
}
