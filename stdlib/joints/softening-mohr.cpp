// Joint model `softening-mohr`: Coulomb slip whose strength falls with slip, and whose friction heals at rest.
// docs/joint-models/softening-mohr.md has the equations; (n) below are their numbers.
#include "stdlib/joints/coulomb.hpp"
#include "kaya/law/elementary.hpp"
#include "kaya/law/rows.hpp"

namespace {

using namespace kaya::joints::coulomb;
using kaya::joints::arctangent_in_degrees;
using kaya::joints::power;

enum OwnProperty : std::size_t { slip_distance = property_count, exponent, healing, healing_time };

constexpr auto all_properties =
    properties +
    std::to_array<kaya_jproperty>({
        {"dc", "slip-distance", "length", "slip over which strength falls to its residual value", NAN, 0, INFINITY, 0},
        {"alpha", "", "-", "exponent of the fall; 1: straight", 1, 0.1, 10, 0},
        {"healing", "", "-", "1: friction is back at its peak when the joint has come to rest", 1, 0, 1, 0},
        {"healing-time", "", "time", "rest that healing needs", 0, 0, INFINITY, 0},
    });

enum OwnHistory : std::size_t { weakening = history_count, rest, friction_current, dilation_at };

constexpr auto all_history = history +
                             std::to_array<kaya_jhistory>({
                                 {"weakening", "length", "slip since the joint last healed"},
                                 {"rest", "time", "time since the last slip"},
                                 {"friction-current", "angle", "angle of friction at this slip"},
                             }) +
                             history_of_dilation;

/// Remaining fraction of the difference between peak and residual strength after a slip (1).
struct Fall {
    double per_distance, exponent;

    [[gnu::always_inline]] double left(double slipped) const {
        const double part = 1 - slipped * per_distance, kept = power(std::max(part, 1e-300), exponent);
        return part > 0 ? kept : 0;
    }
};

template <bool dilates> void run_rows(kaya_jbatch* batch, const Values& values) {
    const double* p = batch->properties;
    const double peak = values.tangent[0], residual = values.tangent[1];
    const Fall fall{1 / p[slip_distance], p[exponent]};
    // A joint that slips has not rested at all.
    const double rest_needed =
        p[healing] != 0 ? std::max(p[healing_time], std::numeric_limits<double>::min()) : INFINITY;
    const double time_step = batch->time_step;

    const Columns columns(*batch, dilation_at);
    double* weak = batch->history[weakening];
    double* rests = batch->history[rest];
    double* angle = batch->history[friction_current];
    const std::size_t n = batch->n;
    KAYA_INDEPENDENT_ROWS
    for (std::size_t i = 0; i < n; ++i) {
        // A bond that broke in tension is lost; a sliding one is worn, and neither heals.
        const bool broken = (columns.states[i] & (tension_now | tension_past)) != 0;
        const double rest_before = rests[i], weak_before = weak[i];
        const double worn = fall.left(columns.slips[i]), bonded = broken ? 0 : worn;
        const double tangent = residual + (peak - residual) * fall.left(weak_before); // (2)
        const double cohesive = values.cohesion[1] + (values.cohesion[0] - values.cohesion[1]) * bonded;
        const double tensile = values.tension[1] + (values.tension[0] - values.tension[1]) * bonded;
        const auto outcome = step<dilates>(columns, i, values.kn, values.ks,
                                           {tensile, values.tension[1], values.dilatancy, values.last_dilation},
                                           Line{cohesive * columns.area[i], tangent});
        const double rested = outcome.excess > 0 ? 0 : rest_before + time_step;
        const bool healed = rested >= rest_needed;
        const double weakened = healed ? 0 : weak_before + outcome.slipped;
        rests[i] = rested;
        weak[i] = weakened;
        angle[i] = arctangent_in_degrees(residual + (peak - residual) * fall.left(weakened));
    }
}

ptrdiff_t run(kaya_jbatch* batch) {
    const Values values(batch->properties);
    if (values.dilatancy > 0) run_rows<true>(batch, values);
    else run_rows<false>(batch, values);
    return -1;
}

const char* check_fall(const double* p) {
    if (!(p[slip_distance] > 0)) return "dc is 0: give the slip over which the strength falls, or use jmodel mohr";
    if (p[friction_residual] > p[friction])
        return "friction-residual is above friction: this joint only weakens with slip, give a friction of at least "
               "that";
    return check(p);
}

constexpr kaya_jmodel descriptor =
    model("softening-mohr", "Coulomb slip that weakens with slip and heals at rest", all_properties, all_history, run,
          check_fall, initialise_with_angle<friction_current>);

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
