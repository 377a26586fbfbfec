// Joint model `continuously-yielding`: shear stress that nears a bounding strength, which wears off with plastic
// displacement. docs/joint-models/continuously-yielding.md has the equations; (n) below are their numbers.
#include "stdlib/joints/coulomb.hpp"
#include "stdlib/joints/elementary.hpp"
#include "stdlib/joints/power_spring.hpp"

#include <iterator>

namespace {

using namespace kaya::joints;

enum Property {
    stiffness_normal,
    stiffness_shear,
    exponent_normal,
    exponent_shear,
    kn_minimum,
    kn_maximum,
    ks_minimum,
    ks_maximum,
    friction,
    friction_initial,
    roughness,
    dilates,
    property_count
};

constexpr kaya_jproperty properties[] = {
    {"kn-initial", "jkn kn stiffness-normal", "stress/length", "a_n: normal stiffness at a normal stress of 1", NAN, 0,
     INFINITY, 0},
    {"ks-initial", "jks ks stiffness-shear", "stress/length", "a_s: shear stiffness at a normal stress of 1", NAN, 0,
     INFINITY, 0},
    {"exponent-normal", "jen", "-", "e_n: power of the normal stress in the normal stiffness", 0, 0, 1, 0},
    {"exponent-shear", "jes", "-", "e_s: power of the normal stress in the shear stiffness", 0, 0, 1, 0},
    {"kn-minimum", "", "stress/length",
     "least normal stiffness; not given: 1/100 of kn-initial if its exponent is above 0", NAN, 0, INFINITY, 1},
    {"kn-maximum", "", "stress/length", "greatest normal stiffness; not given: no limit", NAN, 0, INFINITY, 1},
    {"ks-minimum", "", "stress/length",
     "least shear stiffness; not given: 1/100 of ks-initial if its exponent is above 0", NAN, 0, INFINITY, 1},
    {"ks-maximum", "", "stress/length", "greatest shear stiffness; not given: no limit", NAN, 0, INFINITY, 1},
    {"friction", "jfriction fric", "angle", "intrinsic angle of friction, of the worn joint", NAN, 0, 80, 0},
    {"friction-initial", "jif", "angle", "angle of friction that the joint starts towards", NAN, 0, 80, 0},
    {"roughness", "jr", "length", "R: plastic displacement in which the difference of the two falls to 1/e", NAN, 0,
     INFINITY, 0},
    {"dilation", "", "-", "1: the joint dilates by the angle of its shear stress above the intrinsic friction", 0, 0, 1,
     0},
};
static_assert(std::size(properties) == property_count);

enum History { closure, friction_mobilised, plastic, reversal_ratio, heading, history_count };

constexpr kaya_jhistory history[] = {
    {"closure", "length", "closure of the joint; negative: how far it is open"},
    {"friction-current", "angle", "angle of the bounding strength, phi_m"},
    {"plastic-strain", "length", "plastic shear displacement, added up"},
    {"reversal-ratio", "-", "shear stress over bounding strength at the last reversal, r"},
    {"heading", "-", "cosine between the last motion and the shear resistance that it met"},
};
static_assert(std::size(history) == history_count);

constexpr const char* state_names = "open past-peak";
constexpr uint32_t is_open = 1, is_past_peak = 2;
constexpr double largest_ratio = 0.75; // of r: beyond it F would be noise

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
        const double stress = batch->area[i] > 0 ? std::max(0.0, batch->normal_force[i] / batch->area[i]) : 0;
        double& closed = batch->history[closure][i];
        if (stress > 0)
            closed = spring.closure(stress);
        else
            closed = std::min({0.0, closed, -batch->normal_disp[i]});
        double& angle = batch->history[friction_mobilised][i];
        if (angle == 0) angle = batch->properties[friction_initial];
        batch->normal_stiffness[i] = spring.tangent(stress);
        batch->shear_stiffness[i] = shear.at(stress);
    }
    return -1;
}

/// Motion of one step along its own direction, at one normal stress.
struct Advance {
    double stress;       ///< resistance along the motion at the end
    double plastic;      ///< displacement (6)
    double friction;     ///< phi_m at the end (5)
    double bound_before; ///< bounding strength at the mean of the angles
};

/// (2), (3) and (5) integrated over the step: for a fixed bound the stress nears it exponentially, and for a known
/// plastic displacement so does the angle; two passes with the mean angle make the step of second order.
Advance advance(double start, double motion, double ks, double ratio, double normal, double angle, double intrinsic,
                double per_roughness) {
    Advance a{start, 0, angle, normal * tangent_of_degrees(angle)};
    for (int pass = 0; pass < 2; ++pass) {
        const double bound = normal * tangent_of_degrees(0.5 * (angle + a.friction));
        a.bound_before = bound;
        const double left = bound > 0 ? exponential(std::max(-700.0, -ks * motion / (bound * (1 - ratio)))) : 0;
        a.stress = std::min(bound + (start - bound) * left, start + ks * motion); // F is 1 at most
        a.plastic = std::max(0.0, motion - (a.stress - start) / ks);
        a.friction = intrinsic + (angle - intrinsic) * exponential(std::max(-700.0, -a.plastic * per_roughness));
    }
    return a;
}

ptrdiff_t run(kaya_jbatch* batch) {
    const double* p = batch->properties;
    const PowerSpring spring = normal_spring(p);
    const PowerStiffness shear = shear_stiffness(p);
    const double per_roughness = 1 / p[roughness], intrinsic = p[friction];
    const bool dilation_acts = p[dilates] != 0;

    for (std::size_t i = 0; i < batch->n; ++i) {
        const double area = batch->area[i], per_area = area > 0 ? 1 / area : 0;
        double& closed = batch->history[closure][i];
        double& angle = batch->history[friction_mobilised][i];
        double& ratio = batch->history[reversal_ratio][i];
        double& head = batch->history[heading][i];

        const double old_normal = batch->normal_force[i] * per_area, old_ks = shear.at(old_normal);
        const double old_bound = old_normal * tangent_of_degrees(angle);
        closed -= batch->normal_disp_inc[i];

        // Resistance on the side that is moved: minus the force on block 2.
        double resistance[3], motion[3], way = 0, dot = 0, old_square = 0;
        for (int k = 0; k < 3; ++k) {
            resistance[k] = -batch->shear_force[k][i] * per_area;
            motion[k] = batch->shear_disp_inc[k][i];
            old_square += resistance[k] * resistance[k];
            way += motion[k] * motion[k];
            dot += resistance[k] * motion[k];
        }
        const double size = std::sqrt(old_square);
        way = std::sqrt(way);
        const double over = old_bound > 0 ? std::max(1.0, size / old_bound) : 1;
        // The motion turns back when it goes against the resistance after it went with it, or the other way round (4).
        const bool turns = size > 0 && way > 0 && dot * head < 0;

        // Dilation closes the joint further, which changes the normal stress (1) and with it all the rest.
        double normal = 0, ks = 0, bound = 0, kept = 1, along = 0, lifting = 0, across = 1;
        Advance step{};
        for (int pass = 0; pass < (dilation_acts ? 3 : 1); ++pass) {
            normal = std::max(0.0, spring.stress(closed + lifting));
            ks = shear.at(normal);
            bound = normal * tangent_of_degrees(angle);
            // A normal stress that falls takes resistance with it, as much as stiffness (7) and bounding strength say.
            kept = std::min(1.0, ks / old_ks);
            if (size * kept > bound * over) kept = bound * over / size;
            along = way > 0 ? dot / way * kept : 0; // component in the direction of motion
            step = {along, 0, angle, bound};
            if (!(way > 0 && bound > 0)) continue;
            const double last_ratio = turns ? std::min(largest_ratio, along / bound) : ratio;
            step = advance(along, way, ks, last_ratio, normal, angle, intrinsic, per_roughness);
            // Resistance across the motion is worn off by the plastic part of the motion.
            across = exponential(std::max(-700.0, -ks * step.plastic / step.bound_before));
            const double above = coulomb::degrees_of_tangent(step.stress / normal) - intrinsic; // (8)
            if (dilation_acts) lifting = tangent_of_degrees(std::max(0.0, above)) * step.plastic;
        }
        if (turns && bound > 0) ratio = std::min(largest_ratio, along / bound);

        double worked = 0, new_square = 0, new_along = 0, fresh[3];
        for (int k = 0; k < 3; ++k) {
            const double direction = way > 0 ? motion[k] / way : 0;
            const double part = way > 0 ? along * direction : 0;
            fresh[k] = (resistance[k] * kept - part) * across + (way > 0 ? step.stress * direction : 0);
            if (!(bound > 0)) fresh[k] = 0;
            worked += 0.5 * (resistance[k] + fresh[k]) * motion[k];
            new_square += fresh[k] * fresh[k];
            new_along += fresh[k] * direction;
            batch->shear_force[k][i] = -fresh[k] * area;
        }
        closed += lifting;
        normal = std::max(0.0, spring.stress(closed));
        // What is put in and neither stored in the springs nor spent on dilation.
        const double stored = 0.5 * new_square / shear.at(normal) - 0.5 * old_square / old_ks;
        const double lifted = 0.5 * (old_normal + normal) * lifting;
        batch->frictional_work[i] += area * (worked - stored - lifted);

        const double new_size = std::sqrt(new_square);
        if (way > 0 && new_size > 0) head = new_along / new_size;
        if (!(bound > 0)) ratio = head = 0;
        angle = step.friction;
        batch->history[plastic][i] += step.plastic;
        batch->normal_force[i] = normal * area;
        batch->normal_stiffness[i] = spring.tangent(normal);
        batch->shear_stiffness[i] = shear.at(normal);
        batch->state[i] = (normal > 0 ? 0 : is_open) |
                          (step.stress > 0 && step.stress >= normal * tangent_of_degrees(angle) && step.plastic > 0 ? is_past_peak
                                                                                                           : 0);
    }
    batch->stiffness_changed = 1;
    return -1;
}

const char* check(const double* p) {
    if (!(p[stiffness_normal] > 0)) return "kn-initial (jkn) is 0: give the joint a normal stiffness";
    if (!(p[stiffness_shear] > 0)) return "ks-initial (jks) is 0: give the joint a shear stiffness";
    if (!(p[roughness] > 0))
        return "roughness (jr) is 0: give the plastic displacement over which the joint wears, or use jmodel mohr";
    if (p[friction] > p[friction_initial])
        return "friction is above friction-initial: this joint only wears, give a friction-initial of at least that";
    if (!(p[friction_initial] > 0)) return "friction-initial is 0: a joint without friction is jmodel mohr";
    if (const char* fault = fault_of_limits(normal_spring(p).stiffness(),
                                            "kn-minimum is 0: a joint without stiffness at first touch never closes, "
                                            "give a small value",
                                            "kn-minimum is above kn-maximum: exchange them"))
        return fault;
    return fault_of_limits(shear_stiffness(p),
                           "ks-minimum is 0: give the joint a small shear stiffness at first touch",
                           "ks-minimum is above ks-maximum: exchange them");
}

void max_stiffness(const double* p, double* normal, double* shear) {
    *normal = normal_spring(p).first_tangent();
    *shear = shear_stiffness(p).at(0);
}

constexpr kaya_jmodel descriptor = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "continuously-yielding",
    "Continuously yielding joint of Cundall and Hart",
    "1.0",
    properties,
    property_count,
    history,
    history_count,
    state_names,
    initialise,
    run,
    check,
    max_stiffness,
};

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
