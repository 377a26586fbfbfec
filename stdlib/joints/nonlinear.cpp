// Joint model `nonlinear`: Coulomb slip with stiffnesses that are powers of the normal stress.
// docs/joint-models/nonlinear.md has the equations; (n) below are their numbers.
#include "stdlib/joints/coulomb.hpp"
#include "stdlib/joints/power_spring.hpp"

#include <iterator>

namespace {

using namespace kaya::joints;
using coulomb::tan_degrees;

enum Property {
    stiffness_normal,
    stiffness_shear,
    kn_minimum,
    kn_maximum,
    exponent_normal,
    ks_minimum,
    ks_maximum,
    exponent_shear,
    friction,
    cohesion,
    tension,
    dilation,
    dilation_zero,
    friction_residual,
    cohesion_residual,
    property_count
};

constexpr kaya_jproperty properties[] = {
    {"stiffness-normal", "jkn kn kn-initial", "stress/length", "normal stiffness at a normal stress of 1", NAN, 0,
     INFINITY, 0},
    {"stiffness-shear", "jks ks ks-initial", "stress/length", "shear stiffness at a normal stress of 1", NAN, 0,
     INFINITY, 0},
    {"kn-minimum", "", "stress/length",
     "least normal stiffness; not given: 1/100 of stiffness-normal if its exponent is above 0", NAN, 0, INFINITY, 1},
    {"kn-maximum", "", "stress/length", "greatest normal stiffness; not given: no limit", NAN, 0, INFINITY, 1},
    {"exponent-normal", "jen", "-", "power of the normal stress in the normal stiffness", 0, 0, 1, 0},
    {"ks-minimum", "", "stress/length",
     "least shear stiffness; not given: 1/100 of stiffness-shear if its exponent is above 0", NAN, 0, INFINITY, 1},
    {"ks-maximum", "", "stress/length", "greatest shear stiffness; not given: no limit", NAN, 0, INFINITY, 1},
    {"exponent-shear", "jes", "-", "power of the normal stress in the shear stiffness", 0, 0, 1, 0},
    coulomb::friction_row,
    coulomb::cohesion_row,
    coulomb::tension_row,
    coulomb::dilation_row,
    coulomb::dilation_zero_row,
    coulomb::friction_residual_row,
    coulomb::cohesion_residual_row,
};
static_assert(std::size(properties) == property_count);

enum History { closure, slip, history_count };

constexpr kaya_jhistory history[] = {
    {"closure", "length", "closure of the joint; negative: how far it is open"},
    coulomb::slip_row,
};
static_assert(std::size(history) == history_count);

PowerSpring normal_spring(const double* p) {
    return PowerSpring({p[stiffness_normal], p[exponent_normal], p[kn_minimum], p[kn_maximum]});
}

PowerStiffness shear_stiffness(const double* p) {
    return {p[stiffness_shear], p[exponent_shear], p[ks_minimum], p[ks_maximum]};
}

ptrdiff_t initialise(kaya_jbatch* batch) {
    const PowerSpring spring = normal_spring(batch->properties);
    const PowerStiffness shear = shear_stiffness(batch->properties);
    for (std::size_t i = 0; i < batch->n; ++i) {
        const double stress = batch->area[i] > 0 ? batch->normal_force[i] / batch->area[i] : 0;
        double& closed = batch->history[closure][i];
        if (stress != 0)
            closed = spring.closure(stress);
        else
            closed = std::min({0.0, closed, -batch->normal_disp[i]});
        // What is apart has no bond that could pull it together.
        if (stress == 0 && -closed > 1e-9 * std::sqrt(batch->area[i])) batch->state[i] |= coulomb::tension_past;
        batch->normal_stiffness[i] = spring.tangent(stress);
        batch->shear_stiffness[i] = shear.at(stress);
    }
    return -1;
}

/// Strength and dilation of one row; stresses.
struct Yield {
    double cohesion, tangent, dilatancy, dilation_left;

    double at(double normal_stress) const { return std::max(0.0, cohesion + normal_stress * tangent); }
};

/// Slip that brings the trial down to the strength, which dilation raises (3).
double slip_to_strength(const PowerSpring& spring, const Yield& yield, double closed, double trial, double ks) {
    double slipped = 0;
    for (int k = 0; k < 40; ++k) {
        const double dilating = std::min(slipped, yield.dilation_left);
        const double stress = spring.stress(closed + yield.dilatancy * dilating);
        const double over = trial - ks * slipped - yield.at(stress);
        const double rise = slipped < yield.dilation_left ? yield.tangent * yield.dilatancy * spring.tangent(stress) : 0;
        const double more = over / (ks + rise);
        slipped = std::max(0.0, slipped + more);
        if (std::abs(more) <= 1e-15 * slipped) break;
    }
    return slipped;
}

ptrdiff_t run(kaya_jbatch* batch) {
    const double* p = batch->properties;
    const PowerSpring spring = normal_spring(p);
    const PowerStiffness shear = shear_stiffness(p);
    const double peak_friction = tan_degrees(p[friction]);
    const double residual_friction =
        std::isnan(p[friction_residual]) ? peak_friction : tan_degrees(p[friction_residual]);
    const double dilatancy = tan_degrees(p[dilation]);
    const double last_dilation = p[dilation_zero] > 0 ? p[dilation_zero] : INFINITY;

    for (std::size_t i = 0; i < batch->n; ++i) {
        const double area = batch->area[i], per_area = area > 0 ? 1 / area : 0;
        uint32_t& state = batch->state[i];
        double& closed = batch->history[closure][i];
        double& slips = batch->history[slip][i];
        const bool failed = state != 0;
        const double old_normal = batch->normal_force[i] * per_area;
        const double old_ks = shear.at(old_normal);

        const double before = closed;
        closed -= batch->normal_disp_inc[i];
        double normal = spring.stress(closed); // (1)
        const bool breaks = normal < (failed ? 0.0 : -p[tension]);
        const double lost = breaks && before < 0 ? 0.5 * old_normal * old_normal / spring.first_tangent() : 0;
        if (breaks) normal = 0;
        const bool apart = breaks || (failed && closed < 0);

        // A falling normal stress takes shear force with its stiffness; a rising one adds none (2).
        const double ks = shear.at(normal), kept = std::min(1.0, ks / old_ks);
        double old[3], trial[3], trial_size = 0, old_square = 0;
        for (int k = 0; k < 3; ++k) {
            old[k] = batch->shear_force[k][i] * per_area;
            trial[k] = old[k] * kept - ks * batch->shear_disp_inc[k][i];
            trial_size += trial[k] * trial[k];
            old_square += old[k] * old[k];
        }
        trial_size = std::sqrt(trial_size);

        const Yield yield{failed ? p[cohesion_residual] : p[cohesion], failed ? residual_friction : peak_friction,
                          dilatancy, std::max(0.0, last_dilation - slips)};
        double slipped = 0, dilating = 0, limit = trial_size;
        const bool slides = apart ? false : trial_size > yield.at(normal);
        if (apart) limit = 0;
        if (slides) {
            slipped = slip_to_strength(spring, yield, closed, trial_size, ks);
            dilating = std::min(slipped, yield.dilation_left);
            closed += dilatancy * dilating;
            normal = spring.stress(closed);
            limit = std::min(trial_size, yield.at(normal));
        }
        const double scale = trial_size > 0 ? limit / trial_size : 1;

        double sheared = 0;
        for (int k = 0; k < 3; ++k) {
            const double now = trial[k] * scale;
            sheared -= 0.5 * (old[k] + now) * batch->shear_disp_inc[k][i];
            batch->shear_force[k][i] = now * area;
        }
        // What is put in and neither stored in the springs nor spent on dilation (4).
        const double final_ks = shear.at(normal);
        const double stored = 0.5 * limit * limit / final_ks - 0.5 * old_square / old_ks;
        const double lifted = 0.5 * (old_normal + normal) * dilatancy * dilating;
        batch->frictional_work[i] += area * (sheared - stored - lifted + lost);

        batch->normal_force[i] = normal * area;
        batch->normal_stiffness[i] = spring.tangent(normal);
        batch->shear_stiffness[i] = final_ks;
        slips += slipped;
        state = (state & ~coulomb::now) | ((state & coulomb::now) << coulomb::from_now_to_past) |
                (slides ? coulomb::slip_now : 0) | (breaks ? coulomb::tension_now : 0);
    }
    batch->stiffness_changed = 1;
    return -1;
}

const char* check(const double* p) {
    if (const char* fault = coulomb::fault_of_stiffness(p[stiffness_normal], p[stiffness_shear])) return fault;
    if (const char* fault = fault_of_limits(normal_spring(p).stiffness(),
                                            "kn-minimum is 0: a joint without stiffness at first touch never closes, "
                                            "give a small value",
                                            "kn-minimum is above kn-maximum: exchange them"))
        return fault;
    if (const char* fault = fault_of_limits(shear_stiffness(p),
                                            "ks-minimum is 0: give the joint a small shear stiffness at first touch",
                                            "ks-minimum is above ks-maximum: exchange them"))
        return fault;
    return coulomb::fault_of_residuals(p[tension], 0, p[cohesion], p[cohesion_residual]);
}

void max_stiffness(const double* p, double* normal, double* shear) {
    *normal = normal_spring(p).first_tangent();
    *shear = shear_stiffness(p).at(0);
}

constexpr kaya_jmodel descriptor = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "nonlinear",
    "Coulomb slip with stiffnesses that follow the normal stress",
    "1.0",
    properties,
    property_count,
    history,
    history_count,
    coulomb::state_names,
    initialise,
    run,
    check,
    max_stiffness,
};

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
