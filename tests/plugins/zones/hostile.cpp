// An elastic zone model that does harm as its property `what` says, in some cases after 50 steps.
#include "stdlib/zones/zone.hpp"

#include <cfenv>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <unistd.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace {

using namespace kaya::zones;

enum What {
    nothing,
    ends_by_exit,
    ends_by_underscore_exit,
    never_comes_back,
    uses_a_bad_address,
    divides_by_zero,
    aborts,
    fills_the_stack,
    crashes_behind_its_call,
    writes_to_properties,
    writes_to_strains,
    writes_behind_stresses,
    changes_arithmetic,
    throws_a_number,
    throws_from_check,
    throws_from_moduli,
    has_no_moduli,
};

constexpr std::array properties{bulk_property, shear_property,
                                kaya_zproperty{"what", "", "-", "what it does", 0, 0, 99, 0, KAYA_ZREDUCE_NONE}};
constexpr std::array<kaya_jhistory, 1> history{{{"steps", "-", "steps run"}}};

What what_of(const double* p) { return static_cast<What>(static_cast<int>(p[2])); }

// Hides the endless recursion from the compiler.
__attribute__((noinline)) int deeper(volatile int* depth) {
    volatile char room[4096];
    *depth = *depth + 1;
    room[0] = static_cast<char>(*depth);
    return *depth > 0 ? deeper(depth) + room[0] : 0;
}

void crash_soon() {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    volatile int* volatile nowhere = nullptr;
    *nowhere = 1;
}

void do_harm(What what, kaya_zbatch& batch) {
    volatile int zero = 0;
    switch (what) {
    case ends_by_exit: std::exit(0);
    case ends_by_underscore_exit: _exit(0);
    case never_comes_back:
        for (volatile double again = 1; again > 0;) again = 1;
        break;
    case uses_a_bad_address: *reinterpret_cast<volatile int*>(static_cast<std::size_t>(zero) + 16) = 1; break;
    case divides_by_zero: zero = 100 / zero; break;
    case aborts: std::abort();
    case fills_the_stack: deeper(&zero); break;
    case crashes_behind_its_call:
        if (batch.history[0][0] == 51) std::thread(crash_soon).detach();
        break;
    case writes_to_properties: const_cast<double*>(batch.properties)[0] *= 2; break;
    case throws_a_number: throw 7;
    default: break;
    }
}

ptrdiff_t run(kaya_zbatch* batch) {
    const What what = what_of(batch->properties);
    if (what == writes_to_strains) const_cast<double*>(batch->strain_inc[4])[0] = 0.5;
    if (what == writes_behind_stresses) batch->stress[5][batch->n] = 0;
    if (what == changes_arithmetic) {
        std::fesetround(FE_UPWARD);
#if defined(__SSE2__)
        _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
    }
    for (batch->row = 0; batch->row < batch->n; ++batch->row) batch->history[0][batch->row] += 1;
    batch->row = 0;
    if (batch->history[0][0] > 50) do_harm(what, *batch);
    add_elastic(*batch, {batch->properties[0], batch->properties[1]});
    return -1;
}

const char* check(const double* p) {
    if (what_of(p) == throws_from_check) throw std::runtime_error("no table");
    return nullptr;
}

void moduli(const double* p, double* bulk, double* shear) {
    if (what_of(p) == throws_from_moduli) throw std::runtime_error("no table");
    *bulk = what_of(p) == has_no_moduli ? NAN : p[0];
    *shear = p[1];
}

constexpr kaya_zmodel descriptor = model("hostile", "does harm", properties, history, "", false, run, check, moduli);

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
