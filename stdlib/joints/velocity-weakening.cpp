// Joint model `velocity-weakening`: Coulomb slip whose friction falls with the speed of sliding.
// docs/joint-models/velocity-weakening.md has the equations; (n) below are their numbers.
#include "stdlib/joints/coulomb.hpp"
#include "kaya/law/elementary.hpp"
#include "kaya/law/rows.hpp"

namespace {

using namespace kaya::joints::coulomb;
using kaya::joints::arctangent_in_degrees;
using kaya::joints::power;

enum OwnProperty : std::size_t { exponent = property_count, reference_velocity, use_plastic };

constexpr auto all_properties = [] {
    auto rows =
        properties +
        std::to_array<kaya_jproperty>({
            {"exponent", "", "-", "power of the speed in the fall of friction", 1, 0.1, 10, 0},
            {"reference-velocity", "", "length/time", "speed at which half of the fall is done", NAN, 0, INFINITY, 0},
            {"use-plastic", "", "-",
             "1: speed counts only while the joint slips, a joint that sticks has its friction at rest", 0, 0, 1, 0},
        });
    // The values before and after failure of the other models are the values at low and high speed here.
    rows[friction] = {"friction-static",  "friction jfriction fric", "angle", "angle of friction at rest", 0, 0, 90, 0,
                      KAYA_JROLE_FRICTION};
    rows[friction_residual] = {
        "friction-dynamic", "", "angle", "angle of friction of fast sliding; not given: that at rest", NAN, 0, 90, 1};
    return rows;
}();

enum OwnHistory : std::size_t { velocity = history_count, friction_current, dilation_at };

constexpr auto all_history = history +
                             std::to_array<kaya_jhistory>({
                                 {"velocity", "length/time", "speed of the two sides along the joint in the last step"},
                                 {"friction-current", "angle", "angle of friction in the last step"},
                             }) +
                             history_of_dilation;

template <bool dilates> void run_rows(kaya_jbatch* batch, const Values& values) {
    const double* p = batch->properties;
    const double at_rest = values.tangent[0], fast = values.tangent[1];
    const double per_time = batch->time_step > 0 ? 1 / batch->time_step : 0;
    const double per_velocity = 1 / p[reference_velocity], power_of_speed = p[exponent];
    const bool plastic = p[use_plastic] != 0;

    const Columns columns(*batch, dilation_at);
    double* speeds = batch->history[velocity];
    double* angle = batch->history[friction_current];
    const std::size_t n = batch->n;
    KAYA_INDEPENDENT_ROWS
    for (std::size_t i = 0; i < n; ++i) {
        const bool failed = columns.states[i] != 0;
        const double moved =
            std::sqrt(columns.shear_x[i] * columns.shear_x[i] + columns.shear_y[i] * columns.shear_y[i] +
                      columns.shear_z[i] * columns.shear_z[i]);
        const bool sticks = plastic && (columns.states[i] & slip_now) == 0;
        const double speed = moved * per_time, part = sticks ? 0 : speed * per_velocity;
        const double fall = power(std::max(part, 1e-300), power_of_speed);
        const double tangent = fast + (at_rest - fast) / (1 + (part > 0 ? fall : 0)); // (1)
        step<dilates>(columns, i, values.kn, values.ks, values.limits(failed),
                      Line{Values::of(values.cohesion, failed) * columns.area[i], tangent});
        speeds[i] = speed;
        angle[i] = arctangent_in_degrees(tangent);
    }
}

ptrdiff_t run(kaya_jbatch* batch) {
    const Values values(batch->properties);
    if (values.dilatancy > 0) run_rows<true>(batch, values);
    else run_rows<false>(batch, values);
    return -1;
}

const char* check_fall(const double* p) {
    if (!(p[reference_velocity] > 0))
        return "reference-velocity is 0: give the speed at which half of the friction's fall is done";
    if (p[friction_residual] > p[friction])
        return "friction-dynamic is above friction-static: this joint weakens with speed, give a friction-static of at "
               "least that";
    return check(p);
}

constexpr kaya_jmodel descriptor =
    model("velocity-weakening", "Coulomb slip with friction that falls with speed", all_properties, all_history, run,
          check_fall, initialise_with_angle<friction_current>);

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
