// Sets upward rounding and flushing of denormal numbers in its first step, and does not restore them.
#include "tests/plugins/plugin.hpp"

#include <cfenv>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace {

ptrdiff_t run(kaya_jbatch* batch) {
    std::fesetround(FE_UPWARD);
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
    return plugin::push(batch);
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("rounds-up");
    model.run = run;
    return &model;
}
