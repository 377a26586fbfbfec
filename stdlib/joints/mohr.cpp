// Joint model `mohr`: Coulomb slip with cohesion, tension cut-off, dilation and residual strength.
// docs/joint-models/mohr.md has the equations.
#include "stdlib/joints/coulomb.hpp"
#include "kaya/law/rows.hpp"

namespace {

namespace coulomb = kaya::joints::coulomb;

template <bool dilates> void run_rows(kaya_jbatch* batch, const coulomb::Values& values) {
    const coulomb::Columns columns(*batch, coulomb::history_count);
    const std::size_t n = batch->n;
    KAYA_INDEPENDENT_ROWS
    for (std::size_t i = 0; i < n; ++i) {
        const bool failed = columns.states[i] != 0;
        coulomb::step<dilates>(columns, i, values.kn, values.ks, values.limits(failed),
                               values.line(failed, columns.area[i]));
    }
}

ptrdiff_t run(kaya_jbatch* batch) {
    const coulomb::Values values(batch->properties);
    if (values.dilatancy > 0) run_rows<true>(batch, values);
    else run_rows<false>(batch, values);
    return -1;
}

constexpr auto history = coulomb::operator+(coulomb::history, coulomb::history_of_dilation);

constexpr kaya_jmodel descriptor = coulomb::model(
    "mohr", "Coulomb slip with tension cut-off, dilation and residual strength", coulomb::properties, history, run);

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
